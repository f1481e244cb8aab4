//! \file
//! A triangle mesh as plain arrays: as a view, and as an owner.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/types.h"

namespace agvd {

//! #V x 3 positions and #F x 3 vertex indices, not owned.
struct MeshView {
    std::span<const Vec3> positions;      //!< #V x 3, mesh units.
    std::span<const Triangle> triangles;  //!< #F x 3, vertices.
};

//! #V x 3 positions and #F x 3 vertex indices.
struct TriangleMesh {
    std::vector<Vec3> positions;      //!< #V x 3, mesh units.
    std::vector<Triangle> triangles;  //!< #F x 3, vertices.

    //! Must not outlive the mesh.
    [[nodiscard]] MeshView view() const { return {positions, triangles}; }
    //! Every function of a MeshView takes a TriangleMesh. The view must not outlive the mesh.
    operator MeshView() const { return view(); }
};

}  // namespace agvd
