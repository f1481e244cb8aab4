// Within a radius the work is done on a patch, whose vertices and faces are those of the surface in
// their order; else on the surface itself.
#include "agvd/paths/distances.h"

#include <algorithm>
#include <optional>
#include <tuple>

#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/patch.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

// Points as those of a patch; none where the patch has no such face.
std::vector<std::optional<SurfacePoint>> on_patch(const Patch& patch,
                                                  std::span<const SurfacePoint> points) {
    std::vector<std::optional<SurfacePoint>> moved;
    for (const SurfacePoint& point : points) {
        const Index rank = rank_of(patch.faces, point.face.value());
        const bool is_there = rank < patch.faces.size() && patch.faces[rank] == point.face.value();
        moved.push_back(is_there ? std::optional(SurfacePoint{FaceId(rank), point.barycentric})
                                 : std::nullopt);
    }
    return moved;
}

// The points on the surface that is propagated on.
using Places = std::span<const std::optional<SurfacePoint>>;

std::vector<Index> faces_of(Places places) {
    std::vector<Index> faces;
    for (const auto& place : places) {
        if (place) faces.push_back(place->face.value());
    }
    return distinct(std::move(faces));
}

// \param vertices  of each vertex that of the whole surface; empty: the same.
Distances distances_on(const Surface& surface, std::span<const SurfacePoint> sites, Places places,
                       std::span<const Index> vertices, const DistanceOptions& options) {
    const Propagation propagation = propagate(surface, sites,
                                              {.points = options.points,
                                               .shapes = options.shapes,
                                               .max_error = options.max_error,
                                               .max_distance = options.max_distance,
                                               .relay_faces = faces_of(places),
                                               .num_threads = options.num_threads,
                                               .progress = options.progress});
    Distances result;
    result.certified_error = propagation.certified_error;
    std::vector<std::pair<Index, Index>> reached;  // Of the whole, and here.
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        if (!propagation.vertex_site[v].is_valid()) continue;
        reached.emplace_back(vertices.empty() ? v : vertices[v], v);
    }
    // The fans of one vertex of the whole: the nearest counts.
    std::sort(reached.begin(), reached.end(), [&](const auto& a, const auto& b) {
        return std::tuple(a.first, propagation.vertex_distance[a.second], a.second) <
               std::tuple(b.first, propagation.vertex_distance[b.second], b.second);
    });
    for (const auto& [vertex, here] : reached) {
        if (!result.vertices.empty() && result.vertices.back() == vertex) continue;
        result.vertices.push_back(vertex);
        result.vertex_site.push_back(propagation.vertex_site[here]);
        result.vertex_distance.push_back(propagation.vertex_distance[here]);
    }
    for (const auto& place : places) {
        const PointLabel label = place ? label_at(surface, propagation, *place) : PointLabel{};
        const double distance = label.distance.value_or(infinity);
        const bool is_reached = label.site.is_valid() && distance <= options.max_distance;
        result.point_site.push_back(is_reached ? label.site : SiteId());
        result.point_distance.push_back(is_reached ? distance : infinity);
    }
    return result;
}

}  // namespace

Distances find_distances(const Surface& surface, std::span<const SurfacePoint> sites,
                         std::span<const SurfacePoint> points, const DistanceOptions& options) {
    check_sites(surface, points);
    check_sites(surface, sites);
    std::vector<std::optional<SurfacePoint>> places(points.begin(), points.end());
    if (!(options.max_distance < infinity) || !(options.max_distance >= 0) ||
        surface.has_own_lengths || !options.shapes.empty()) {
        return distances_on(surface, sites, places, {}, options);  // Which refuses NaN.
    }
    Poller poller(options.progress);
    const Ticker ticker(poller);
    const Patch patch =
        patch_of(surface, faces_within(surface, sites, options.max_distance, ticker), ticker);
    std::vector<SurfacePoint> moved;
    for (const auto& site : on_patch(patch, sites)) moved.push_back(*site);
    return distances_on(patch.surface, moved, on_patch(patch, points), patch.vertices, options);
}

}  // namespace agvd
