//! \file
//! A surface thinned to chosen points: the triangulation of these that it carries.
#pragma once

#include <span>
#include <vector>

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace agvd {

struct ThinnedMesh {
    //! Of points and extra vertices: i < #points is points[i], others are extra[i - #points].
    std::vector<Triangle> triangles;
    //! On the surface: vertices without which the result would be no simplicial manifold of the
    //! surface's topology, as far as was found.
    std::vector<SurfacePoint> extra;
    std::size_t flips = 0;
};

//! Makes points the vertices of a component and takes all other vertices away, one by one: the
//! lengths around a vertex are scaled until it is flat, its edges are flipped until it has three
//! (or, on the boundary, two faces), and it goes ([liu2023]). What is left meets the Delaunay
//! condition by its own lengths, as far as it stays simplicial. Since every step keeps a simplicial
//! manifold, the result is one, of the component's topology; what would break that stays.
//! A boundary goes through the points that lie on it, at least three vertices.
//!
//! \param surface  may be a Delta-complex.
//! \param faces    ascending: one component of it.
//! \param points   of these faces, no two at one place.
//! Cost: O(n log n) in practice, n = faces + points.
[[nodiscard]] ThinnedMesh thin(const Surface& surface, std::span<const Index> faces,
                               std::span<const SurfacePoint> points);

}  // namespace agvd
