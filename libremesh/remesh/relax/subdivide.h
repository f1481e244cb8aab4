//! \file
//! From few sites to many, by new ones between them.
#pragma once

#include <optional>

#include "remesh/relax/site_labels.h"

namespace remesh::detail {

//! Sites and their triangulation.
struct TriangulatedSites {
    std::vector<agvd::SurfacePoint> sites;
    std::vector<agvd::Triangle> triangles;
    std::vector<double> weights;  //!< #sites
};

//! The sites and new ones in the middles between neighbours, so that most have six neighbours; the
//! closest pairs go without where that would be too many, and where it would be too few the
//! largest triangles get one more. Nothing if there is no room for `count` sites even so.
//!
//! \param weights  #sites; new ones get the mean of the sites that they are between.
//! Cost: O(n log n).
[[nodiscard]] std::optional<TriangulatedSites> subdivide(
    const agvd::Surface& surface, const std::vector<agvd::SurfacePoint>& sites,
    const std::vector<double>& weights, const SiteDual& dual, agvd::Index count);

}  // namespace remesh::detail
