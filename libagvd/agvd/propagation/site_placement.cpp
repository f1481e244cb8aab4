#include "agvd/propagation/site_placement.h"

#include <algorithm>
#include <tuple>

#include "agvd/mesh/surface_points.h"

namespace agvd {
SitePlacement::SitePlacement(const Surface& surface, std::span<const SurfacePoint> sites) {
    check_sites(surface, sites);
    std::vector<Index> chosen;
    for (Index s = 0; s < sites.size(); ++s) {
        if (!vertex_of(surface, sites[s])) chosen.push_back(s);
    }
    for (const Index i : distinct_points(surface, points_of(sites, chosen))) {
        const Index s = chosen[i];
        for_each_side(surface, sites[s], [&](const SurfacePoint& point, Index) {
            placed_.push_back({s, point});
        });
    }
    std::stable_sort(placed_.begin(), placed_.end(), [](const PlacedSite& a, const PlacedSite& b) {
        return std::tie(a.point.face, a.site) < std::tie(b.point.face, b.site);
    });
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

}  // namespace agvd
