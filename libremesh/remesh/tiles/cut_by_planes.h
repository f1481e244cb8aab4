//! \file
//! A mesh cut along planes. Private to remeshing.
#pragma once

#include "remesh/tiles/face_origins.h"
#include "remesh/tiles/plane_tree.h"

namespace remesh {

//! A mesh whose faces lie in one cell each.
struct CutMesh {
    TriangleMesh mesh;        //!< Its first vertices are those of the mesh that was cut.
    FaceOrigins parts;        //!< Where its faces lie on that mesh.
    std::vector<Index> cell;  //!< #F: up to `snap` in which cell of the tree each lies.
};

//! Divides the faces of a mesh where they cross the planes of a tree. Neighbours share the new
//! vertices, so a manifold stays one. A cut depends on nothing but the faces at it.
//! \param snap  > 0, mesh units: a vertex this near to a plane lies on it.
//! Cost: O(n log #cells).
[[nodiscard]] CutMesh cut_by_planes(const MeshView& mesh, const PlaneTree& tree, double snap,
                                    Ticker ticker);

}  // namespace remesh
