#include "remesh/repair/distinct_sites.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "agvd/mesh/point_faces.h"

namespace remesh {
namespace {

using agvd::Index;
using agvd::Surface;
using agvd::SurfacePoint;

// A vertex, an edge or a face, and where on it.
struct Place {
    int dimension;
    Index element;
    std::array<double, 3> where;

    auto operator<=>(const Place&) const = default;
};

Place place_of(const Surface& surface, const SurfacePoint& point) {
    if (const auto vertex = agvd::vertex_of(surface, point)) return {0, *vertex, {}};
    if (const auto h = agvd::half_edge_of(point)) {
        const agvd::Vec3 at = agvd::position(surface.mesh.view(), point);
        return {1, surface.edge[*h], {at.x(), at.y(), at.z()}};
    }
    return {2, point.face.value(), point.barycentric};
}

}  // namespace

std::vector<SurfacePoint> distinct_sites(const Surface& surface,
                                         const std::vector<SurfacePoint>& sites) {
    std::vector<std::pair<Place, Index>> places;
    places.reserve(sites.size());
    for (Index i = 0; i < sites.size(); ++i) places.emplace_back(place_of(surface, sites[i]), i);
    std::sort(places.begin(), places.end());
    std::vector<bool> is_first(sites.size(), true);
    for (std::size_t i = 1; i < places.size(); ++i) {
        if (places[i].first == places[i - 1].first) is_first[places[i].second] = false;
    }
    std::vector<SurfacePoint> result;
    result.reserve(sites.size());
    for (Index i = 0; i < sites.size(); ++i) {
        if (is_first[i]) result.push_back(sites[i]);
    }
    return result;
}

}  // namespace remesh
