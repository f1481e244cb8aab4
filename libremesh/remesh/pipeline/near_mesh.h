//! \file
//! Meshes that keep a distance from the input.
#pragma once

#include "remesh/pipeline/improvable_mesh.h"

namespace remesh::detail {

//! Brings a mesh within the distance, and takes vertices away where it is much nearer
//! (keep_distance).
//! \param curved  with a bound, and without junctions.
//! \return the largest distance at the points looked at, mesh units; unset: it is not proved.
//! Cost: that of keep_distance.
[[nodiscard]] std::optional<double> bring_near(const CurvedSurface& curved, PlacedMesh& mesh,
                                               const StageContext& context);

}  // namespace remesh::detail
