// Points of each surface are compared with the other one. Where one is too far edges get half as
// long as those of the result there.
#include "remesh/pipeline/meet_distance.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "agvd/core/number_text.h"
#include "agvd/core/parallel.h"
#include "agvd/mesh/scale.h"
#include "remesh/curves/crease_chains.h"
#include "remesh/pipeline/curves.h"
#include "remesh/pipeline/mesh_with_curves.h"
#include "remesh/pipeline/sizes.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/placement/far_points.h"
#include "remesh/quality/area_samples.h"

namespace remesh::detail {
namespace {

constexpr Index samples_per_surface = 100'000;
constexpr Index query_grain = 1024;
constexpr int max_rounds = 16;
// A mesh of the input's edges that takes so many times their vertices is none.
constexpr Index most_growth = 4;

using Corners = std::array<Vec3, 3>;

double mean_side(const MeshView& mesh, Index face) {
    const Corners t = corners_of(mesh, face);
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += (t[(k + 1) % 3] - t[k]).norm();
    return sum / 3;
}

// #V: a corner of a face, 3 f + k, at each vertex; no_index: none.
std::vector<Index> find_corner_of_vertex(const MeshView& mesh) {
    std::vector<Index> corner(mesh.positions.size(), no_index);
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        for (Index k = 0; k < 3; ++k) corner[mesh.triangles[f][k]] = 3 * f + k;
    }
    return corner;
}

// The result, the input, and what is known of them.
class Comparison {
public:
    // \param targets  #V of the result: lengths that its edges were to have; or empty.
    Comparison(const SearchedMesh& input, const SearchedMesh& result,
               std::span<const double> targets, double limit, int num_threads, Poller& poller)
        : input_(input),
          result_(result),
          targets_(targets),
          limit_(limit),
          num_threads_(num_threads),
          poller_(poller) {}

    // Looks at the vertices and samples of one surface.
    void look_at_points(bool is_input) {
        const MeshView& mesh = (is_input ? input_ : result_).mesh;
        const AreaSamples samples(mesh);
        const std::vector<Index> corner_of_vertex = find_corner_of_vertex(mesh);
        const auto num_vertices = static_cast<Index>(mesh.positions.size());
        run(num_vertices + samples_per_surface, [&](Index i, MeasuredDistance& found) {
            if (i >= num_vertices) {
                look_at(is_input, samples.at(i - num_vertices, samples_per_surface), found);
            } else if (corner_of_vertex[i] != no_index) {
                look_at(is_input, point_on(corner_of_vertex[i], 0), found);
            }
        });
    }
    // Looks at all of one surface.
    void prove(bool is_input) {
        const MeshView& mesh = (is_input ? input_ : result_).mesh;
        MeasuredDistance found;
        for (const auto& [face, far] :
             find_far_faces(mesh, is_input ? result_ : input_, limit_, num_threads_, poller_)) {
            const SurfacePoint point =
                closest_point_on_triangle(corners_of(mesh, face), FaceId(face), far.at).point;
            take(is_input, point, far.at, far.nearest, found);
        }
        take_over(found);
    }
    [[nodiscard]] const MeasuredDistance& farthest() const { return farthest_; }

private:
    void look_at(bool is_input, const SurfacePoint& point, MeasuredDistance& found) const {
        const Vec3 at = position((is_input ? input_ : result_).mesh, point);
        take(is_input, point, at, (is_input ? result_ : input_).tree.query(at), found);
    }
    void take(bool is_input, const SurfacePoint& point, const Vec3& at, const ClosestPoint& nearest,
              MeasuredDistance& found) const {
        const double distance = std::sqrt(nearest.distance_sq);
        widen(found, distance, at);
        if (distance <= provable_share * limit_) return;
        // Where a piece is missed the edges of the result tell little: longer ones reach it.
        const double edge = edge_at((is_input ? nearest.point : point).face.value());
        found.lengths.push_back({is_input ? point : nearest.point, std::max(edge, distance) / 2});
    }
    // The mean edge of a face of the result, or the length meant for it: the shorter one.
    [[nodiscard]] double edge_at(Index face) const {
        double length = mean_side(result_.mesh, face);
        for (const Index v : result_.mesh.triangles[face]) {
            if (!targets_.empty()) length = std::min(length, targets_[v]);
        }
        return length;
    }
    template <typename Look>
    void run(Index count, const Look& look) {
        std::vector<MeasuredDistance> chunks(num_chunks(count, query_grain));
        parallel_chunks(
            count, query_grain, num_threads_,
            [&](Index chunk, Index begin, Index end) {
                for (Index i = begin; i < end; ++i) look(i, chunks[chunk]);
            },
            poller_);
        for (const MeasuredDistance& chunk : chunks) take_over(chunk);
    }
    void take_over(const MeasuredDistance& found) {
        widen(farthest_, found.largest, found.where);
        farthest_.lengths.insert(farthest_.lengths.end(), found.lengths.begin(),
                                 found.lengths.end());
    }
    static void widen(MeasuredDistance& found, double distance, const Vec3& where) {
        if (distance <= found.largest) return;
        found.largest = distance;
        found.where = where;
    }

    SearchedMesh input_, result_;
    std::span<const double> targets_;
    double limit_;
    int num_threads_;
    Poller& poller_;
    MeasuredDistance farthest_;
};

// Edges that lose this share of the distance count: beside others, more were too far away.
constexpr double hinge_share = 0.25;
// As a share of the size: below, rounding keeps even equal meshes from being proved.
constexpr double provable_size = 1e-10;

// Creases, and edges that a distance needs, if they take less than half of the vertices that
// lengths ask for; or none. With a small distance they are all edges that are not flat.
// \param[out] most_vertices  of a mesh with them.
std::vector<std::uint8_t> find_needed_edges(const CleanedInput& cleaned,
                                            const RemeshOptions& options, double limit,
                                            Index& most_vertices) {
    if (options.features != Features::Auto) return {};
    RemeshResult unused;
    const double spacing = spacing_for(cleaned, options);
    const FoundCurves found = find_curves(cleaned, spacing, {options, unused});
    std::vector<std::uint8_t> needed = find_hinges(cleaned.surface, spacing, hinge_share * limit,
                                                   options.num_threads, cleaned_progress(options));
    for (Index e = 0; e < needed.size(); ++e) needed[e] |= found.is_crease[e];
    if (needed == found.is_crease) return {};
    most_vertices = find_sizes(cleaned, found, spacing, {}, {}, {options, unused}).num_samples;
    const Index num_needed =
        fewest_network_vertices(cleaned.surface, needed, spacing, found.junctions, cleaned.locked);
    if (num_needed > most_vertices / 2) return {};
    most_vertices = std::min(most_vertices, most_growth * num_needed);
    return needed;
}

}  // namespace

MeasuredDistance measure_distance(const MeshView& input, const ClosestPointTree& input_tree,
                                  const MeshView& result, std::span<const double> targets,
                                  double limit, int num_threads, const Progress& progress) {
    Poller poller(progress);
    const ClosestPointTree result_tree(result, poller.progress());
    Comparison comparison({input, input_tree}, {result, result_tree}, targets, limit, num_threads,
                          poller);
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
    DistanceBound bound{mesh.view(), tree, limit};
    finer.sizing.max_edge = std::min(finer.sizing.max_edge, (box.high - box.low).norm());
    std::vector<SizedPoint> lengths;
    MeasuredDistance best{.largest = infinity};
    std::size_t num_vertices = 0;
    finer.sizing.count = aim;
    Index most_vertices = 0;
    std::vector<std::uint8_t> needed;
    if (limit >= provable_size * box.longest_side()) {
        needed = find_needed_edges(cleaned, finer, limit, most_vertices);
    }
    bound.hinges = needed;
    for (int round = 0; round < max_rounds; ++round) {
        RemeshResult result = run(finer, lengths, &bound);
        if (!bound.hinges.empty() && result.mesh.positions.size() > most_vertices) {
            bound.hinges = {};
            lengths.clear();
            continue;
        }
        MeasuredDistance found{.largest = result.sizing.largest_distance};
        found.is_within = found.largest > 0;  // It is proved.
        if (!found.is_within) {
            found = measure_distance(mesh, tree, result.mesh, result.sizing.targets, limit,
                                     options.num_threads, progress_at(Stage::Check, options, 1));
            result.sizing.largest_distance = found.largest;
        }
        if (found.largest < best.largest) {
            best = found;
            num_vertices = result.mesh.positions.size();
        }
        // Half the lengths would take more vertices than the curves that were left out. Sheets are
        // welded even where the distance does not need it.
        const bool is_welded = options.junctions == Junctions::Keep;
        const Index for_curves =
            std::max(found.is_within ? 0 : result.features.samples_for_all,
                     found.is_within && !is_welded ? 0 : result.junctions.samples_for_all);
        if (round + 1 < max_rounds && for_curves > result.sizing.num_samples &&
            for_curves <= 2 * num_vertices) {
            finer.sizing.count = NumSamples{};
            finer.num_samples = for_curves;
            continue;
        }
        if (found.is_within) return result;
        finer.sizing.count = aim;
        lengths.insert(lengths.end(), found.lengths.begin(), found.lengths.end());
    }
    throw ConstraintUnmet("the largest distance asked for is " + number_text(limit) + ", and " +
                          number_text(best.largest) + " was reached with " +
                          std::to_string(num_vertices) + " vertices, near " +
                          place_text(best.where, box.longest_side()) + "; allow a larger distance");
}

}  // namespace remesh::detail
