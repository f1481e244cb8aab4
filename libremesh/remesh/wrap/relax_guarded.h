//! \file
//! Better triangles for a mesh in space. Private to runs on wraps.
#pragma once

#include <optional>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/closest_point.h"
#include "remesh/wrap/guarded_mesh.h"

namespace remesh::detail {

//! Moves vertices over a surface and flips edges, where the worst triangle around gets better.
//! \param mesh     near the surface. No face intersects one that it did not.
//! \param surface  with the side that the mesh has.
//! \return by vertex: where it lies now, if it has moved.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(#surface log #surface), and some hundred queries for each vertex at narrow faces.
std::vector<std::optional<SurfacePoint>> relax_guarded(GuardedMesh& mesh, const MeshView& surface,
                                                       const Progress& progress);

}  // namespace remesh::detail
