#include "agvd/mesh/distinct_points.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/point_faces.h"

namespace agvd {

PlaceOnSurface place_of(const Surface& surface, const SurfacePoint& point) {
    if (const auto vertex = vertex_of(surface, point)) return {*vertex, {}};
    if (const auto h = half_edge_of(point)) {
        const Index edge = surface.edge[*h];
        double tail = point.barycentric[*h % 3], head = point.barycentric[Surface::next(*h) % 3];
        if (surface.edge_half[edge] != *h) std::swap(tail, head);
        return {surface.num_vertices() + edge, {tail, head, 0}};
    }
    return {surface.num_vertices() + surface.num_edges() + point.face.value(), point.barycentric};
}

std::vector<Index> distinct_points(const Surface& surface, std::span<const SurfacePoint> points) {
    std::vector<std::pair<PlaceOnSurface, Index>> places;
    places.reserve(points.size());
    for (Index i = 0; i < points.size(); ++i) places.emplace_back(place_of(surface, points[i]), i);
    std::sort(places.begin(), places.end());
    const auto end = std::unique(places.begin(), places.end(),
                                 [](const auto& a, const auto& b) { return a.first == b.first; });
    std::vector<Index> distinct;
    distinct.reserve(points.size());
    for (auto place = places.begin(); place != end; ++place) distinct.push_back(place->second);
    std::sort(distinct.begin(), distinct.end());
    return distinct;
}

std::vector<SurfacePoint> points_of(std::span<const SurfacePoint> points,
                                    std::span<const Index> chosen) {
    std::vector<SurfacePoint> result;
    result.reserve(chosen.size());
    for (const Index i : chosen) result.push_back(points[i]);
    return result;
}

}  // namespace agvd
