//! \file
//! Thins a patch between curves to its sites.
#pragma once

#include "agvd/intrinsic/thin.h"

namespace remesh {

//! Applies agvd::thin, then removes the extra vertices that it leaves by collapses, if all of them
//! can be removed. On a curve no patch may have a vertex that the patch across the curve lacks.
//!
//! \param surface  may be a Delta-complex.
//! \param faces    ascending: one component of it.
//! \param points   in these faces, no two at one place.
//! Cost: as agvd::thin.
[[nodiscard]] agvd::ThinnedMesh thin_patch(const agvd::Surface& surface,
                                           std::span<const agvd::Index> faces,
                                           std::span<const agvd::SurfacePoint> points);

}  // namespace remesh
