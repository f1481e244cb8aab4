#include "remesh/pipeline/coarse_input.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/patch.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/pipeline/curves.h"

namespace remesh::detail {
namespace {

// An input with no more faces than this, in all or for each sample, is used as it is: coarsening
// would cost more than it saves (measured on scans of 70 000 and 1.4 million faces).
constexpr Index enough_faces = 40'000, enough_faces_per_sample = 50;
// Another one keeps this many. With so many, shape and RMS distance of the result are those of the
// input itself.
constexpr Index coarse_faces = 20'000, coarse_faces_per_sample = 16;
// In spacings: of edges, and of the distance from the input.
constexpr double longest_edge = 0.5, most_distance = 0.02;

Index faces_for(Index num_samples, Index faces, Index faces_per_sample) {
    const Index most_samples = no_index / faces_per_sample;
    return std::max(faces, faces_per_sample * std::min(num_samples, most_samples));
}

bool may_coarsen(const CleanedInput& cleaned, const RemeshOptions& options) {
    return !refers_to_input(options) && cleaned.locked.empty() && !options.lock_boundary &&
           options.fit.value_or(is_relaxed(options)) && options.propagation.max_error != 0 &&
           !std::holds_alternative<MaxDistance>(options.sizing.count);
}

// The nearest point among those that are, along the surface, no farther from a vertex than twice as
// far as `point` is in space.
SurfacePoint nearest_around(const Surface& surface, Index vertex, const Vec3& point) {
    const MeshView mesh = surface.mesh.view();
    const SurfacePoint start = point_at(surface, vertex);
    ClosestPoint best{start, mesh.positions[vertex],
                      (mesh.positions[vertex] - point).squaredNorm()};
    for (const Index f : faces_within(surface, {&start, 1}, 2 * std::sqrt(best.distance_sq))) {
        const ClosestPoint here = closest_point_on_triangle(corners_of(mesh, f), FaceId(f), point);
        if (here.distance_sq < best.distance_sq) best = here;
    }
    return best.point;
}

}  // namespace

std::optional<CoarsenOptions> coarsening_for(Index num_faces, Index num_samples, double spacing) {
    if (num_faces <= faces_for(num_samples, enough_faces, enough_faces_per_sample)) {
        return std::nullopt;
    }
    return CoarsenOptions{
        .num_faces = faces_for(num_samples, coarse_faces, coarse_faces_per_sample),
        .longest_edge = longest_edge * spacing,
        .most_distance = most_distance * spacing};
}

std::vector<std::uint8_t> vertices_that_stay(const Surface& surface,
                                             std::span<const Index> origin) {
    std::vector<std::uint8_t> stays;
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        stays.push_back(surface.is_boundary_vertex(v) ? 1 : 0);
    }
    std::vector<std::pair<Index, Index>> copies;  // (origin, vertex)
    for (Index v = 0; v < origin.size(); ++v) copies.emplace_back(origin[v], v);
    std::sort(copies.begin(), copies.end());
    for (std::size_t i = 1; i < copies.size(); ++i) {
        if (copies[i].first != copies[i - 1].first) continue;
        stays[copies[i].second] = stays[copies[i - 1].second] = 1;
    }
    return stays;
}

std::optional<CleanedInput> coarse_input(const CleanedInput& cleaned, double spacing,
                                         const StageContext& context) {
    const auto& [options, result] = context;
    std::optional<CoarsenOptions> coarsening =
        coarsening_for(cleaned.surface.num_faces(), options.num_samples, spacing);
    if (!coarsening || !may_coarsen(cleaned, options)) return std::nullopt;
    coarsening->num_threads = options.num_threads;
    coarsening->progress = cleaned_progress(options);
    const StageClock clock(Stage::Clean, result);
    const Surface& fine = cleaned.surface;
    const std::vector<std::uint8_t> is_crease = find_own_creases(cleaned, spacing, options);
    CoarseMesh coarse =
        coarsen(fine, is_crease, vertices_that_stay(fine, cleaned.vertex_origin), *coarsening);
    result.coarse_faces = static_cast<Index>(coarse.mesh.triangles.size());
    CleanedInput input;
    input.given = cleaned.given;
    input.surface =
        build_surface(coarse.mesh.view(), options.num_threads, cleaned_progress(options));
    input.topology = analyze_topology(input.surface.mesh.view(), cleaned_progress(options));
    if (!is_crease.empty()) {
        input.creases.resize(input.surface.num_edges());
        for (Index e = 0; e < input.creases.size(); ++e) {
            input.creases[e] = coarse.mark[input.surface.edge_half[e]];
        }
    }
    if (!cleaned.vertex_origin.empty()) {
        input.vertex_origin = take(cleaned.vertex_origin, coarse.vertex_origin);
    }
    input.finer_vertex = std::move(coarse.vertex_origin);
    input.finer = &cleaned;
    return input;
}

std::vector<SurfacePoint> to_finer(const CleanedInput& coarse,
                                   std::span<const SurfacePoint> points) {
    const MeshView mesh = coarse.surface.mesh.view();
    std::vector<SurfacePoint> found;
    found.reserve(points.size());
    for (const SurfacePoint& point : points) {
        const Vec3 at = position(mesh, point);
        const Triangle& corners = mesh.triangles[point.face.value()];
        const Index nearest = *std::ranges::min_element(
            corners, {}, [&](Index v) { return (mesh.positions[v] - at).squaredNorm(); });
        found.push_back(nearest_around(coarse.finer->surface, coarse.finer_vertex[nearest], at));
    }
    return found;
}

}  // namespace remesh::detail
