//! \file
//! A path walked back from a point to its site, along the straight lines to the images that the
//! relays of the faces name. Private to the paths.
#pragma once

#include <optional>
#include <span>

#include "agvd/core/progress.h"
#include "agvd/paths/geodesic_path.h"
#include "agvd/paths/site_ends.h"

namespace agvd {

//! What a path is traced on: propagate(surface, sites) with relays in all faces on the way.
struct TracedField {
    const Surface& surface;
    const Propagation& propagation;
    const SiteEnds& ends;
};

//! A path as straighten_path takes it.
struct TracedPath {
    std::vector<SurfacePoint> points;
    std::vector<FaceId> faces;  //!< Of each piece.
    SiteId site;                //!< Where it ends.
    double start = 0;           //!< The distance of the site there.
};

//! \param point  snapped.
//! \return none where a face on the way has no relays, or rounding leads astray.
//! Cost: O(relays) at the point and at each vertex that the path meets, O(1) in other faces; with
//! errors in the relays O(relays) in all faces.
[[nodiscard]] std::optional<TracedPath> trace_to_site(const TracedField& field,
                                                      const SurfacePoint& point, Ticker& ticker);

//! A path from a point to its site: the one that is traced, or another one if that has not the
//! length of the distance. In find_paths.cpp.
[[nodiscard]] SitePath path_to_ends(const TracedField& field, const SurfacePoint& point,
                                    const Progress& progress);

}  // namespace agvd
