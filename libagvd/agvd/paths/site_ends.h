//! \file
//! Where paths to sites end. Private to the paths.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "agvd/core/groups.h"
#include "agvd/propagation/propagate.h"
#include "agvd/propagation/shape_source.h"

namespace agvd {

//! A point of a site.
struct SiteEnd {
    SurfacePoint place;
    double start = 0;  //!< The distance that its site has there.
};

//! The points and shapes of each site. Keeps references.
class SiteEnds {
public:
    //! \param points, propagation  propagate(surface, points).
    //! Cost: O(points), and sorting what belongs to shapes.
    SiteEnds(const Surface& surface, std::span<const SurfacePoint> points,
             const Propagation& propagation);

    //! Where the paths of a relay begin, if that is on its site; else they come from a vertex.
    //! \param view   a point of the relay's face.
    //! \param slack  starts that differ by less are equal.
    [[nodiscard]] std::optional<SiteEnd> of_relay(const Relay& relay, const SurfacePoint& view,
                                                  double slack) const;

    //! The least start of a line or region of the site that has the half-edge as a side: paths end
    //! there that leave their face through it.
    [[nodiscard]] std::optional<double> at_side(Index half_edge, SiteId site) const;

    //! The place of a site that is nearest in space: a point, or a vertex of a shape. Cost: O(all
    //! of them).
    [[nodiscard]] SiteEnd nearest_in_space(SiteId site, const SurfacePoint& point) const;

private:
    [[nodiscard]] double start_of_point(Index point) const;

    const Surface& surface_;
    std::span<const SurfacePoint> points_;
    const Propagation& propagation_;
    Groups parts_;  // Of each site: points, then shapes behind them.
    std::vector<ShapeSource> shapes_;
};

}  // namespace agvd
