//! \file
//! Which sites a face holds.
#pragma once

#include <algorithm>
#include <span>
#include <tuple>
#include <vector>

#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"

namespace agvd {

//! A face, and a region that holds it.
struct PlacedRegion {
    Index face;
    Index site;
    friend auto operator<=>(const PlacedRegion&, const PlacedRegion&) = default;
};

//! A site that lies in a face or on one of its edges (not at a corner), seen from that face.
struct PlacedSite {
    Index site;
    SurfacePoint point;
};

//! Calls each(point, half_edge) for the faces that hold a point which lies at no vertex: one, or
//! both sides of the edge on which it lies. The half-edge is that edge, or no_index.
template <typename Each>
void for_each_side(const Surface& surface, const SurfacePoint& point, const Each& each) {
    const Index half_edge = half_edge_of(point).value_or(no_index);
    each(point, half_edge);
    if (half_edge == no_index || surface.twin[half_edge] == no_index) return;
    each(across_edge(surface, point, half_edge), surface.twin[half_edge]);
}

//! A region at all points of its faces.
//! \param start  of the region.
[[nodiscard]] inline Relay region_relay(const Surface& surface, const PlacedRegion& region,
                                        double start) {
    const Index h = 3 * region.face;
    return {0, infinity, start, 0, surface.length_of(h), SiteId(region.site), h};
}

//! The placed sites of each face. A site on an edge is listed once for each side of the edge. A
//! site that lies where an earlier one does is not listed.
class SitePlacement {
public:
    SitePlacement() = default;
    //! \param site_of_point  #sites: the numbers to list; empty: their own.
    //! \throw InvalidSites as check_sites.
    SitePlacement(const Surface& surface, std::span<const SurfacePoint> sites,
                  std::span<const Index> site_of_point = {}) {
        check_sites(surface, sites);
        std::vector<Index> chosen;
        for (Index s = 0; s < sites.size(); ++s) {
            if (!vertex_of(surface, sites[s])) chosen.push_back(s);
        }
        for (const Index i : distinct_points(surface, take(sites, chosen))) {
            const Index s = chosen[i];
            for_each_side(surface, sites[s], [&](const SurfacePoint& point, Index) {
                placed_.push_back({site_of_point.empty() ? s : site_of_point[s], point});
            });
        }
        std::stable_sort(placed_.begin(), placed_.end(),
                         [](const PlacedSite& a, const PlacedSite& b) {
                             return std::tie(a.point.face, a.site) < std::tie(b.point.face, b.site);
                         });
        holds_site_.assign(surface.num_faces(), false);
        for (const PlacedSite& placed : placed_) holds_site_[placed.point.face.value()] = true;
    }

    //! \param first  the number of the first shape.
    void add_regions(std::span<const SiteShape> shapes, Index first) {
        for (const SiteShape& shape : shapes) {
            for (const Index face : shape.faces) regions_.push_back({face, first});
            ++first;
        }
        std::sort(regions_.begin(), regions_.end());
        regions_.erase(std::unique(regions_.begin(), regions_.end()), regions_.end());
    }

    //! All sites lie at vertices.
    [[nodiscard]] bool is_empty() const { return placed_.empty(); }
    [[nodiscard]] std::span<const PlacedSite> in_face(Index face) const {
        if (!holds_site_[face]) return {};
        return find_in_face(face);
    }

    //! The regions that hold a face.
    [[nodiscard]] std::span<const PlacedRegion> regions_of(Index face) const {
        if (regions_.empty()) return {};
        const auto [first, last] = std::equal_range(
            regions_.data(), regions_.data() + regions_.size(), PlacedRegion{face, 0},
            [](const auto& a, const auto& b) { return a.face < b.face; });
        return {first, last};
    }

private:
    [[nodiscard]] std::span<const PlacedSite> find_in_face(Index face) const {
        const auto first =
            std::lower_bound(placed_.begin(), placed_.end(), face,
                             [](const PlacedSite& p, Index f) { return p.point.face.value() < f; });
        auto last = first;
        while (last != placed_.end() && last->point.face.value() == face) ++last;
        return std::span(placed_).subspan(static_cast<std::size_t>(first - placed_.begin()),
                                          static_cast<std::size_t>(last - first));
    }

    std::vector<PlacedSite> placed_;  // By (face, site).
    std::vector<PlacedRegion> regions_;
    std::vector<bool> holds_site_;  // #F: a quick test, since most faces hold no site.
};

}  // namespace agvd
