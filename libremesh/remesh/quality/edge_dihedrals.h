//! \file
//! Dihedral angles of any triangles, manifold or not.
#pragma once

#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh::detail {

struct EdgeDihedral {
    Index ends[2];
    //! Between the normals of the two faces, both seen from the same side of the surface for any
    //! orientation, radians; pi for any other number of faces.
    double angle;
    Index num_faces;
};

//! The mesh without copies: vertices with equal coordinates are one, faces that repeat a vertex or
//! another face are dropped.
[[nodiscard]] TriangleMesh without_copies(const MeshView& mesh, Ticker& ticker);

//! \param thin  mesh units: a lower face takes the normal of the face across its longest other
//!              side, over up to six such faces.
//! Cost: O(n log n).
[[nodiscard]] std::vector<EdgeDihedral> edge_dihedrals(const MeshView& mesh, double thin,
                                                       Ticker& ticker);

}  // namespace remesh::detail
