//! \file
//! What the caller locked, on the cleaned surface and in the result.
#pragma once

#include "agvd/mesh/surface.h"
#include "remesh/curves/curve_network.h"
#include "remesh/pipeline/remesh.h"

namespace remesh::detail {

//! Vertices are recognised by their positions, so that those that cleaning welds or copies are
//! found: all vertices at the position of a locked one are locked.
//! \param given    the caller's mesh; may be empty if only the boundary is locked.
//! \param surface  of the cleaned mesh.
//! \throw InvalidInput  there is no such vertex or edge; the text names it.
//! Cost: O(#surface + #locked log #locked).
[[nodiscard]] LockedElements find_locked(const MeshView& given, const RemeshOptions& options,
                                         const Surface& surface);

//! Whether the mesh has all that is locked, by position. Gives these vertices the same bits as
//! before: 0 and -0 are equal positions.
//! Cost: O(#mesh + #locked log #locked).
[[nodiscard]] bool has_locked(const Surface& surface, const LockedElements& locked,
                              TriangleMesh& mesh);

}  // namespace remesh::detail
