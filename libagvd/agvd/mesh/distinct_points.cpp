#include "agvd/mesh/distinct_points.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/point_faces.h"

namespace agvd {

PlaceOnSurface place_of(const Surface& surface, const SurfacePoint& point) {
    const std::uint64_t num_vertices = surface.num_vertices();
    if (const auto vertex = vertex_of(surface, point)) return {*vertex, {}};
    if (const auto h = half_edge_of(point)) {
        const Index low = std::min(*h, surface.twin[*h]);  // no_index is higher.
        double tail = point.barycentric[*h % 3], head = point.barycentric[Surface::next(*h) % 3];
        if (low != *h) std::swap(tail, head);
        return {num_vertices + low, {tail, head, 0}};
    }
    return {num_vertices + surface.twin.size() + point.face.value(), point.barycentric};
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
