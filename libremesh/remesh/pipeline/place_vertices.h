//! \file
//! The best position for each vertex of the dual.
#pragma once

#include "remesh/pipeline/whole_mesh.h"

namespace remesh::detail {

//! Fits the vertices to the surface and moves those of bad triangles, as far as the options ask
//! for it.
//!
//! \param domain   its pieces are found if they were reset, and reset then.
//! \param places   #V of the dual: where each vertex lies on the cleaned surface.
//! \param patches  of the dual; null without a plan.
//! Cost: that of fit_vertices and improve_shape.
[[nodiscard]] PlacedMesh place_vertices(Domain& domain, const CurveSites& curves,
                                        const ValidDual& dual, std::vector<SurfacePoint> places,
                                        const JoinedPatches* patches, const StageContext& context);

}  // namespace remesh::detail
