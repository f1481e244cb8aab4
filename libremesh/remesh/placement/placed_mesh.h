//! \file
//! A mesh whose vertices belong to points of a surface, but may lie off it.
#pragma once

#include <vector>

#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh {

struct PlacedMesh {
    std::vector<SurfacePoint> points;  //!< #V: where each vertex belongs.
    std::vector<Vec3> offsets;         //!< #V: from there to its position.
    std::vector<Triangle> triangles;

    [[nodiscard]] Vec3 position(const MeshView& surface, Index v) const {
        return agvd::position(surface, points[v]) + offsets[v];
    }
};

}  // namespace remesh
