//! \file
//! A mesh whose vertices belong to points of a surface, but may lie off it.
#pragma once

#include <vector>

#include "agvd/mesh/surface_point.h"

namespace remesh {

struct PlacedMesh {
    std::vector<agvd::SurfacePoint> points;  //!< #V: where each vertex belongs.
    std::vector<agvd::Vec3> offsets;         //!< #V: from there to its position.
    std::vector<agvd::Triangle> triangles;

    [[nodiscard]] agvd::Vec3 position(const agvd::MeshView& surface, agvd::Index v) const {
        return agvd::position(surface, points[v]) + offsets[v];
    }
};

}  // namespace remesh
