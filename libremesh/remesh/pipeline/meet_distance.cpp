// Points of each surface are compared with the other one. A point that is too far lowers the length
// at the corners of the input's face that it lies on, or that is nearest to it: to the length of
// the edges of the result there, times what the distance needs if it falls with their square.
#include "remesh/pipeline/meet_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "agvd/core/parallel.h"
#include "agvd/mesh/scale.h"
#include "remesh/placement/far_points.h"
#include "remesh/quality/area_samples.h"

namespace remesh::detail {
namespace {

constexpr Index samples_per_surface = 100'000;
constexpr Index query_grain = 1024;
// Share of the limit from which edges get shorter, and that they aim at.
constexpr double too_far = 0.75, aimed_share = 0.6;

// Edges get no shorter than this share of themselves in one round: where the surface is missed, not
// met badly, their length tells little, and a large face of the input would get millions.
constexpr double least_factor = 0.5;

constexpr int max_rounds = 16;
// Each run places its vertices anew, and other points may be too far then. After so many rounds
// edges get shorter everywhere, too.
constexpr int local_rounds = 5;
constexpr double global_factor = 0.8;

using Corners = std::array<Vec3, 3>;

double mean_side(const MeshView& mesh, Index face) {
    const Corners t = corners_of(mesh, face);
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += (t[(k + 1) % 3] - t[k]).norm();
    return sum / 3;
}

// #V: a face of each vertex; no_index: none.
std::vector<Index> find_face_of_vertex(const MeshView& mesh) {
    std::vector<Index> face(mesh.positions.size(), no_index);
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        for (const Index v : mesh.triangles[f]) face[v] = f;
    }
    return face;
}

// The result, the input, and what is known of them.
class Comparison {
public:
    Comparison(const SearchedMesh& input, const SearchedMesh& result, double limit, int num_threads,
               Poller& poller, std::vector<double>& most_lengths)
        : input_(input),
          result_(result),
          limit_(limit),
          num_threads_(num_threads),
          poller_(poller),
          most_lengths_(most_lengths),
          before_(most_lengths) {}

    // Looks at the vertices and samples of one surface.
    void look_at_points(bool is_input) {
        const MeshView& mesh = (is_input ? input_ : result_).mesh;
        const ClosestPointTree& other = (is_input ? result_ : input_).tree;
        const AreaSamples samples(mesh);
        const std::vector<Index> face_of_vertex = find_face_of_vertex(mesh);
        const auto num_vertices = static_cast<Index>(mesh.positions.size());
        run(num_vertices + samples_per_surface, [&](Index i, Found& found, Ticker&) {
            if (i >= num_vertices) {
                const SurfacePoint sample = samples.at(i - num_vertices, samples_per_surface);
                const Vec3 point = position(mesh, sample);
                take(is_input, point, sample.face.value(), other.query(point), found);
            } else if (face_of_vertex[i] != no_index) {
                const Vec3& point = mesh.positions[i];
                take(is_input, point, face_of_vertex[i], other.query(point), found);
            }
        });
    }
    // Looks at all of one surface.
    void prove(bool is_input) {
        Found found;
        for (const auto& [face, far] :
             find_far_faces((is_input ? input_ : result_).mesh, is_input ? result_ : input_, limit_,
                            num_threads_, poller_)) {
            take(is_input, far.at, face, far.nearest, found);
        }
        take_over(found);
    }
    [[nodiscard]] const MeasuredDistance& farthest() const { return farthest_; }

private:
    // What a chunk of points has found.
    struct Found {
        MeasuredDistance distance;
        std::vector<std::pair<Index, double>> lengths;  // Of vertices of the input.
    };

    void take(bool is_input, const Vec3& point, Index face, const ClosestPoint& nearest,
              Found& found) const {
        const double distance = std::sqrt(nearest.distance_sq);
        if (distance > found.distance.largest) found.distance = {distance, false, point};
        if (distance < too_far * limit_) return;
        const Index other = nearest.point.face.value();
        const double factor = std::max(least_factor, std::sqrt(aimed_share * limit_ / distance));
        const double length = mean_side(result_.mesh, is_input ? other : face);
        // Edges may be longer than they were meant to be: the shorter of both counts.
        for (const Index v : input_.mesh.triangles[is_input ? face : other]) {
            found.lengths.emplace_back(v, factor * std::min(length, before_[v]));
        }
    }
    template <typename Look>
    void run(Index count, const Look& look) {
        std::vector<Found> chunks(num_chunks(count, query_grain));
        parallel_chunks(
            count, query_grain, num_threads_,
            [&](Index chunk, Index begin, Index end) {
                Ticker ticker(poller_);
                for (Index i = begin; i < end; ++i) look(i, chunks[chunk], ticker);
            },
            poller_);
        for (const Found& chunk : chunks) take_over(chunk);
    }
    void take_over(const Found& found) {
        if (found.distance.largest > farthest_.largest) farthest_ = found.distance;
        for (const auto& [v, length] : found.lengths) {
            most_lengths_[v] = std::min(most_lengths_[v], length);
        }
    }

    SearchedMesh input_, result_;
    double limit_;
    int num_threads_;
    Poller& poller_;
    std::vector<double>& most_lengths_;
    std::vector<double> before_;
    MeasuredDistance farthest_;
};

}  // namespace

MeasuredDistance measure_distance(const MeshView& input, const ClosestPointTree& input_tree,
                                  const MeshView& result, double limit,
                                  std::vector<double>& most_lengths, int num_threads,
                                  const Progress& progress) {
    Poller poller(progress);
    const ClosestPointTree result_tree(result, poller.progress());
    Comparison comparison({input, input_tree}, {result, result_tree}, limit, num_threads, poller,
                          most_lengths);
    comparison.look_at_points(true);
    comparison.look_at_points(false);
    if (comparison.farthest().largest > provable_share * limit) return comparison.farthest();
    comparison.prove(true);
    comparison.prove(false);
    MeasuredDistance found = comparison.farthest();
    found.is_within = found.largest <= provable_share * limit;
    return found;
}

RemeshResult meet_distance(const CleanedInput& cleaned, const RemeshOptions& options, double limit,
                           const RunWithLengths& run) {
    RemeshOptions finer = options;
    finer.vertex_count = VertexCount::Add;
    finer.sizing.edges = AdaptiveEdges{};
    MaxError aim{limit};
    const TriangleMesh& mesh = cleaned.surface.mesh;
    const ClosestPointTree tree(mesh, cleaned_progress(options));
    const MeshBox box = box_of(mesh, options.num_threads);
    const DistanceBound bound{mesh.view(), tree, limit};
    std::vector<double> most_lengths(mesh.positions.size(), (box.high - box.low).norm());
    MeasuredDistance best{infinity, false, {}};
    std::size_t num_vertices = 0;
    for (int round = 0; round < max_rounds; ++round) {
        finer.sizing.count = aim;
        RemeshResult result = run(finer, most_lengths, &bound);
        if (result.sizing.largest_distance > 0) return result;  // It is proved.
        const MeasuredDistance found =
            measure_distance(mesh, tree, result.mesh, limit, most_lengths, options.num_threads,
                             progress_at(Stage::Check, options, 1));
        result.sizing.largest_distance = found.largest;
        if (found.is_within) return result;
        if (round >= local_rounds) aim.error *= global_factor;
        if (found.largest < best.largest) {
            best = found;
            num_vertices = result.mesh.positions.size();
        }
    }
    throw ConstraintUnmet("the largest distance asked for is " + std::to_string(limit) + ", and " +
                          std::to_string(best.largest) + " was reached with " +
                          std::to_string(num_vertices) + " vertices, near " +
                          std::to_string(best.where.x()) + ' ' + std::to_string(best.where.y()) +
                          ' ' + std::to_string(best.where.z()) + "; allow a larger distance");
}

}  // namespace remesh::detail
