//! \file
//! Simplifies a surface to chosen points: a triangulation with these points as vertices. Private.
#pragma once

#include "agvd/mesh/surface.h"

namespace agvd {

//! The result of simplify().
struct SimplifiedMesh {
    //! Their vertices are points and extra vertices: i < #points is points[i], others are extra[i -
    //! #points].
    std::vector<Triangle> triangles;
    //! Points of the surface: vertices that were kept, since without them the result would not be a
    //! simplicial manifold of the surface's topology.
    std::vector<SurfacePoint> extra;
};

//! Makes points the vertices of a component and removes all other vertices, one by one ([liu2023]),
//! unless the result would be no simplicial manifold of the component's topology without one. The
//! result is Delaunay by its own lengths, as far as it stays simplicial.
//!
//! \param surface  may be a Delta-complex.
//! \param faces    ascending: one component of it.
//! \param points   of these faces, no two at one position.
//! Cost: O(n log n) in practice, n = faces + points.
[[nodiscard]] SimplifiedMesh simplify(const Surface& surface, std::span<const Index> faces,
                                      std::span<const SurfacePoint> points);

}  // namespace agvd
