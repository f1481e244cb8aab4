//! \file
//! A patch between curves, thinned to its sites.
#pragma once

#include "agvd/intrinsic/thin.h"

namespace remesh {

//! agvd::thin; vertices that it leaves besides the points go by collapses, if they can: beside a
//! curve no patch may have vertices that the patch across lacks.
//!
//! \param surface  may be a Delta-complex.
//! \param faces  ascending: one component of it.
//! \param points   of these faces, no two at one place.
//! Cost: as agvd::thin.
[[nodiscard]] agvd::ThinnedMesh thin_patch(const agvd::Surface& surface,
                                           std::span<const agvd::Index> faces,
                                           std::span<const agvd::SurfacePoint> points);

}  // namespace remesh
