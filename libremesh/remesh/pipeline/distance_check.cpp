// Points of each surface are compared with the other one. A point that is too far lowers the length
// at the corners of the input's face that it lies on, or that is nearest to it: to the length of
// the edges of the result there, times what the distance needs if it falls with their square.
#include "remesh/pipeline/distance_check.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "agvd/core/parallel.h"
#include "remesh/quality/area_samples.h"

namespace remesh::detail {
namespace {

constexpr Index samples_per_surface = 100'000;  // On each surface.
constexpr Index query_grain = 1024;
// Share of the limit from which edges get shorter, and that they aim at.
constexpr double too_far = 0.75, aim = 0.6;
// A point beyond this share of the limit counts as too far: nearer to the limit a proof would take
// ever smaller parts.
constexpr double provable_share = 0.98;

// A point whose distance is too large.
struct FarPoint {
    Index input_face;
    double length;  // Of the edges of the result there.
    double factor;  // To that length.
};

struct ChunkOfPoints {
    MeasuredDistance distance;
    std::vector<FarPoint> far;
};

double mean_side(const MeshView& mesh, Index face) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& t = mesh.triangles[face];
        sum += (mesh.positions[t[(k + 1) % 3]] - mesh.positions[t[k]]).norm();
    }
    return sum / 3;
}

// #V: a face of each vertex; no_index: none.
std::vector<Index> face_of_vertex(const MeshView& mesh) {
    std::vector<Index> face(mesh.positions.size(), no_index);
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        for (const Index v : mesh.triangles[f]) face[v] = f;
    }
    return face;
}

// All vertices and the samples of a mesh.
class Points {
public:
    explicit Points(const MeshView& mesh)
        : mesh_(mesh), samples_(mesh), face_of_vertex_(face_of_vertex(mesh)) {}

    [[nodiscard]] Index size() const {
        return static_cast<Index>(mesh_.positions.size()) + samples_per_surface;
    }
    // Position and face.
    [[nodiscard]] std::pair<Vec3, Index> operator[](Index i) const {
        if (i < mesh_.positions.size()) return {mesh_.positions[i], face_of_vertex_[i]};
        const auto first = static_cast<Index>(mesh_.positions.size());
        const SurfacePoint point = samples_.at(i - first, samples_per_surface);
        return {position(mesh_, point), point.face.value()};
    }

private:
    MeshView mesh_;
    AreaSamples samples_;
    std::vector<Index> face_of_vertex_;
};

// Proves that a triangle lies within a limit of a mesh, or finds a point that does not. Part of it
// is near enough if its centroid is, with its radius added, or if its corners are near one triangle
// of the mesh: the distance from a convex set is largest at a corner. Else it is divided.
class Prover {
public:
    Prover(const MeshView& mesh, const ClosestPointTree& tree, double limit)
        : mesh_(mesh), tree_(tree), limit_(limit) {}

    // \return a point beyond provable_share of the limit, if there is one.
    [[nodiscard]] std::optional<std::pair<Vec3, ClosestPoint>> find_far(
        const std::array<Vec3, 3>& corners, Ticker& ticker) {
        parts_ = {corners};
        while (!parts_.empty()) {
            ticker.tick(query_steps);
            const std::array<Vec3, 3> part = parts_.back();
            parts_.pop_back();
            const Vec3 middle = (part[0] + part[1] + part[2]) / 3;
            const ClosestPoint nearest = tree_.query(middle);
            const double distance = std::sqrt(nearest.distance_sq);
            if (distance > provable_share * limit_) return std::pair(middle, nearest);
            double radius = 0;
            for (const Vec3& corner : part) radius = std::max(radius, (corner - middle).norm());
            if (distance + radius <= limit_ || is_near(part, nearest.point.face)) continue;
            const Vec3 a = (part[1] + part[2]) / 2, b = (part[2] + part[0]) / 2,
                       c = (part[0] + part[1]) / 2;
            parts_.push_back({part[0], c, b});
            parts_.push_back({c, part[1], a});
            parts_.push_back({b, a, part[2]});
            parts_.push_back({a, b, c});
        }
        return std::nullopt;
    }

private:
    [[nodiscard]] bool is_near(const std::array<Vec3, 3>& part, FaceId face) const {
        const Triangle& t = mesh_.triangles[face.value()];
        const std::array corners{mesh_.positions[t[0]], mesh_.positions[t[1]],
                                 mesh_.positions[t[2]]};
        return std::all_of(part.begin(), part.end(), [&](const Vec3& p) {
            return closest_point_on_triangle(corners, face, p).distance_sq <= limit_ * limit_;
        });
    }

    static constexpr std::size_t query_steps = 64;

    MeshView mesh_;
    const ClosestPointTree& tree_;
    double limit_;
    std::vector<std::array<Vec3, 3>> parts_;
};

// The result, the input, and what is known of them.
class Comparison {
public:
    Comparison(const MeshView& input, const MeshView& result, double limit, int num_threads,
               Poller& poller, std::vector<double>& most_lengths)
        : input_(input),
          result_(result),
          limit_(limit),
          num_threads_(num_threads),
          poller_(poller),
          most_lengths_(most_lengths),
          before_(most_lengths) {}

    // Looks at the vertices and samples of one surface.
    void look_at_points(bool is_input, const ClosestPointTree& other) {
        const Points points(is_input ? input_ : result_);
        run(points.size(), [&](Index i, ChunkOfPoints& found, Ticker&) {
            const auto [point, face] = points[i];
            if (face == no_index) return;
            take(is_input, point, face, other.query(point), found);
        });
    }
    // Looks at all of one surface.
    void prove(bool is_input, const ClosestPointTree& other) {
        const MeshView& mesh = is_input ? input_ : result_;
        run(static_cast<Index>(mesh.triangles.size()),
            [&](Index f, ChunkOfPoints& found, Ticker& ticker) {
                Prover prover(is_input ? result_ : input_, other, limit_);
                const auto& [a, b, c] = mesh.triangles[f];
                const auto far = prover.find_far(
                    {mesh.positions[a], mesh.positions[b], mesh.positions[c]}, ticker);
                if (far) take(is_input, far->first, f, far->second, found);
            });
    }
    [[nodiscard]] const MeasuredDistance& farthest() const { return farthest_; }

private:
    void take(bool is_input, const Vec3& point, Index face, const ClosestPoint& nearest,
              ChunkOfPoints& found) const {
        const double distance = std::sqrt(nearest.distance_sq);
        if (distance > found.distance.largest) found.distance = {distance, false, point};
        if (distance < too_far * limit_) return;
        const Index other = nearest.point.face.value();
        found.far.push_back({is_input ? face : other, mean_side(result_, is_input ? other : face),
                             std::sqrt(aim * limit_ / distance)});
    }
    template <typename Look>
    void run(Index count, const Look& look) {
        std::vector<ChunkOfPoints> chunks(num_chunks(count, query_grain));
        parallel_chunks(
            count, query_grain, num_threads_,
            [&](Index chunk, Index begin, Index end) {
                Ticker ticker(poller_);
                for (Index i = begin; i < end; ++i) look(i, chunks[chunk], ticker);
            },
            poller_);
        for (const ChunkOfPoints& chunk : chunks) {
            if (chunk.distance.largest > farthest_.largest) farthest_ = chunk.distance;
            for (const FarPoint& point : chunk.far) lower(point);
        }
    }
    // Edges may be longer than they were meant to be: the shorter of both counts.
    void lower(const FarPoint& point) {
        for (const Index v : input_.triangles[point.input_face]) {
            const double length = std::min(point.length, before_[v]);
            most_lengths_[v] = std::min(most_lengths_[v], point.factor * length);
        }
    }

    MeshView input_, result_;
    double limit_;
    int num_threads_;
    Poller& poller_;
    std::vector<double>& most_lengths_;
    std::vector<double> before_;
    MeasuredDistance farthest_;
};

}  // namespace

DistanceCheck::DistanceCheck(const MeshView& mesh, int num_threads, const Progress& progress)
    : mesh_{{mesh.positions.begin(), mesh.positions.end()},
            {mesh.triangles.begin(), mesh.triangles.end()}},
      tree_(mesh, progress),
      num_threads_(num_threads) {}

MeasuredDistance DistanceCheck::measure(const MeshView& result, double limit,
                                        std::vector<double>& most_lengths,
                                        const Progress& progress) const {
    Poller poller(progress);
    const ClosestPointTree result_tree(result, poller.progress());
    Comparison comparison(mesh_.view(), result, limit, num_threads_, poller, most_lengths);
    comparison.look_at_points(true, result_tree);
    comparison.look_at_points(false, tree_);
    MeasuredDistance found = comparison.farthest();
    if (found.largest > provable_share * limit) return found;
    comparison.prove(true, result_tree);
    comparison.prove(false, tree_);
    found = comparison.farthest();
    found.is_within = found.largest <= provable_share * limit;
    return found;
}

}  // namespace remesh::detail
