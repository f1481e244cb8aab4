//! \file
//! A component's own faces as a mesh to start from where its cells give none.
#pragma once

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace remesh {

//! A triangle mesh whose vertices are points of a surface.
struct SurfaceMesh {
    std::vector<agvd::SurfacePoint> points;  //!< One per vertex.
    std::vector<agvd::Triangle> triangles;   //!< Indices into points.
};

//! The named faces with all their vertices; edges are halved, longest first, until there are at
//! least `least_vertices`. Topology, orientation and shape are those of the faces.
//! \param faces  ascending; closed under adjacency (whole components).
//! Cost: O(size of the result * log of it).
[[nodiscard]] SurfaceMesh component_mesh(const agvd::Surface& surface,
                                         const std::vector<agvd::Index>& faces,
                                         agvd::Index least_vertices,
                                         const agvd::Progress& progress = {});

}  // namespace remesh
