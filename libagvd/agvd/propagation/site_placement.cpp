#include "agvd/propagation/site_placement.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "agvd/core/error.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

bool by_face(const PlacedSite& a, const PlacedSite& b) {
    if (a.point.face != b.point.face) return a.point.face < b.point.face;
    return a.site < b.site;
}

}  // namespace

SitePlacement::SitePlacement(const Surface& surface, std::span<const SurfacePoint> sites) {
    check_sites(surface, sites);
    std::vector<Index> chosen;
    for (Index s = 0; s < sites.size(); ++s) {
        if (!vertex_of(surface, sites[s])) chosen.push_back(s);
    }
    for (const Index i : distinct_points(surface, points_of(sites, chosen))) {
        const Index s = chosen[i];
        placed_.push_back({s, sites[s]});
        const std::optional<Index> half_edge = half_edge_of(sites[s]);
        if (half_edge && surface.twin[*half_edge] != no_index) {
            placed_.push_back({s, across_edge(surface, sites[s], *half_edge)});
        }
    }
    std::stable_sort(placed_.begin(), placed_.end(), by_face);
    holds_site_.assign(surface.num_faces(), false);
    for (const PlacedSite& placed : placed_) holds_site_[placed.point.face.value()] = true;
}

std::span<const PlacedSite> SitePlacement::find_in_face(Index face) const {
    const auto first =
        std::lower_bound(placed_.begin(), placed_.end(), face,
                         [](const PlacedSite& p, Index f) { return p.point.face.value() < f; });
    auto last = first;
    while (last != placed_.end() && last->point.face.value() == face) ++last;
    return {first, last};
}

std::span<const PlacedSite> SitePlacement::seen_from(Index face, Index site) const {
    const PlacedSite key{site, {FaceId(face), {}}};
    const auto [first, last] = std::equal_range(placed_.begin(), placed_.end(), key, by_face);
    assert(first != last);
    return {first, last};
}

}  // namespace agvd
