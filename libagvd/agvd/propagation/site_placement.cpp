#include "agvd/propagation/site_placement.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "agvd/core/error.h"
#include "agvd/mesh/distinct_points.h"

namespace agvd {
namespace {

// Barycentric coordinates that come from files or float sums; checked against 1.
constexpr double barycentric_tolerance = 1e-6;

void check_site(const Surface& surface, const SurfacePoint& site, std::size_t index) {
    const auto refuse = [&](const std::string& why) {
        throw InvalidInput("site " + std::to_string(index) + why);
    };
    if (site.face.value() >= surface.num_faces()) {
        refuse(" names a face that does not exist; there are " +
               std::to_string(surface.num_faces()) + " faces, counted from 0");
    }
    double sum = 0;
    for (const double b : site.barycentric) {
        if (!(b >= 0)) {
            refuse(" has a negative barycentric coordinate; a site must lie in its face");
        }
        sum += b;
    }
    if (!(std::abs(sum - 1) <= barycentric_tolerance)) {
        refuse(" has barycentric coordinates that do not sum to 1; divide them by their sum");
    }
}

bool by_face(const PlacedSite& a, const PlacedSite& b) {
    if (a.point.face != b.point.face) return a.point.face < b.point.face;
    return a.site < b.site;
}

}  // namespace

Vec2 position_in_frame(const Surface& surface, const SurfacePoint& point, Index half_edge) {
    assert(Surface::face(half_edge) == point.face.value());
    const Index k = half_edge % 3;
    const double head = point.barycentric[(k + 1) % 3];
    const double apex = point.barycentric[(k + 2) % 3];
    return apex * surface.apex[half_edge] + Vec2(head * surface.length_of(half_edge), 0);
}

void check_sites(const Surface& surface, std::span<const SurfacePoint> sites) {
    for (Index s = 0; s < sites.size(); ++s) check_site(surface, sites[s], s);
}

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
