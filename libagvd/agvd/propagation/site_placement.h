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
    //! The site as seen from `face`, which must hold it. There are two entries if the site lies on
    //! an edge along which the face is glued to itself.
    [[nodiscard]] std::span<const PlacedSite> seen_from(Index face, Index site) const;

private:
    [[nodiscard]] std::span<const PlacedSite> find_in_face(Index face) const;

    std::vector<PlacedSite> placed_;  // By (face, site).
    std::vector<bool> holds_site_;    // #F: a quick test, since most faces hold no site.
};

}  // namespace agvd
