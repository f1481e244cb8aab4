//! \file
//! Thins a patch between curves to its sites.
#pragma once

#include "agvd/intrinsic/simplify.h"
#include "remesh/names.h"

namespace remesh {

//! Applies thin, then removes the extra vertices that it leaves by collapses, if all of them
//! can be removed. On a curve no patch may have a vertex that the patch across the curve lacks.
//!
//! \param surface  may be a Delta-complex.
//! \param faces    ascending: one component of it.
//! \param points   in these faces, no two at one place.
//! Cost: as thin.
[[nodiscard]] SimplifiedMesh thin_patch(const Surface& surface, std::span<const Index> faces,
                                        std::span<const SurfacePoint> points);

}  // namespace remesh
