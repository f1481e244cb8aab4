//! \file
//! Adds sites between the sites of a triangulation.
#pragma once

#include <optional>

#include "remesh/sites/site_labels.h"

namespace remesh::detail {

//! Sites and their triangulation.
struct TriangulatedSites {
    std::vector<SurfacePoint> sites;
    std::vector<Triangle> triangles;
    std::vector<double> weights;  //!< #sites
};

//! Adds sites in the middles between neighbours, so that most sites have six neighbours. If these
//! are too many, the closest pairs get none; if they are too few, the largest triangles get one
//! site each. Nothing if that is not enough for `count` sites.
//!
//! \param weights  #sites; new ones get the mean of the sites around them.
//! \param unit     #sites: of lengths at each; empty: mesh units.
//! Cost: O(n log n).
[[nodiscard]] std::optional<TriangulatedSites> subdivide(const Surface& surface,
                                                         const std::vector<SurfacePoint>& sites,
                                                         const std::vector<double>& weights,
                                                         const SiteDual& dual, Index count,
                                                         std::span<const double> unit = {});

}  // namespace remesh::detail
