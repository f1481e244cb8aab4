//! \file
//! Sites on a mesh as the caller has it, and on the same mesh cleaned.
#pragma once

#include "agvd/mesh/surface_point.h"
#include "remesh/repair/clean_input.h"

namespace remesh {

//! The same points on `clean.mesh`; `clean` must come from clean_input(mesh).
//! \throw agvd::InvalidInput  a site's face does not exist or was dropped in cleaning, or its
//!        coordinates are not barycentric; the text names the site.
//! Cost: O(#F + #sites).
[[nodiscard]] std::vector<agvd::SurfacePoint> to_cleaned(
    const std::vector<agvd::SurfacePoint>& sites, const agvd::MeshView& mesh,
    const CleanResult& clean);

//! The way back: points of `clean.mesh` on the mesh that it came from.
[[nodiscard]] std::vector<agvd::SurfacePoint> to_original(
    const std::vector<agvd::SurfacePoint>& sites, const agvd::MeshView& mesh,
    const CleanResult& clean);

}  // namespace remesh
