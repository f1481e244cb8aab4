//! \file
//! Which sites a face holds.
#pragma once

#include <span>
#include <vector>

#include "agvd/mesh/surface_points.h"

namespace agvd {

//! A site that lies in a face or on one of its edges (not at a corner), seen from that face.
struct PlacedSite {
    Index site;
    SurfacePoint point;
};

//! The placed sites of each face. A site on an edge is listed once for each side of the edge. A
//! site that lies where an earlier one does is not listed.
class SitePlacement {
public:
    SitePlacement() = default;
    //! \throw InvalidSites as check_sites.
    SitePlacement(const Surface& surface, std::span<const SurfacePoint> sites);

    //! All sites lie at vertices.
    [[nodiscard]] bool is_empty() const { return placed_.empty(); }
    [[nodiscard]] std::span<const PlacedSite> in_face(Index face) const {
        if (!holds_site_[face]) return {};
        return find_in_face(face);
    }

private:
    [[nodiscard]] std::span<const PlacedSite> find_in_face(Index face) const;

    std::vector<PlacedSite> placed_;  // By (face, site).
    std::vector<bool> holds_site_;    // #F: a quick test, since most faces hold no site.
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

}  // namespace agvd
