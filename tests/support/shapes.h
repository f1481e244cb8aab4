//! \file
//! Meshes by formula.
#pragma once

#include "agvd/mesh/surface.h"

namespace shapes {

//! Unit square in the plane z = 0, n x n quads, each cut along the same diagonal.
[[nodiscard]] agvd::TriangleMesh grid(agvd::Index n);
//! Regular tetrahedron, cube (12 faces, edge 1) and icosahedron (radius 1).
[[nodiscard]] agvd::TriangleMesh tetrahedron();
[[nodiscard]] agvd::TriangleMesh cube();
[[nodiscard]] agvd::TriangleMesh icosahedron();
//! Unit sphere: the icosahedron with each face split in four `levels` times.
[[nodiscard]] agvd::TriangleMesh sphere(int levels);
//! Torus of radii 1 and `tube`, n x m quads.
[[nodiscard]] agvd::TriangleMesh torus(agvd::Index n, agvd::Index m, double tube = 0.35);
//! Open cylinder of radius 1 and height 2 around z, n x m quads.
[[nodiscard]] agvd::TriangleMesh tube(agvd::Index n, agvd::Index m);
//! Open tube of height 2 and radius about 1, n x m quads, that ends in lips: the upper quarter is
//! cut so that `teeth` columns are left, one column apart.
[[nodiscard]] agvd::TriangleMesh lips(agvd::Index n, agvd::Index m, agvd::Index teeth);
//! Every face split in four at the edge midpoints; positions are not moved.
[[nodiscard]] agvd::TriangleMesh subdivide(const agvd::TriangleMesh& mesh);
//! Every vertex moved by at most `amount`, reproducibly.
[[nodiscard]] agvd::TriangleMesh jitter(agvd::TriangleMesh mesh, double amount, std::uint64_t seed);
//! Random faces cut into three at a point inside, random edges in two: all new vertices but those
//! on the boundary have no curvature. Faces become needles.
void add_flat_vertices(agvd::TriangleMesh& mesh, agvd::Index count, std::uint64_t seed);
//! Vertices and faces in random order.
[[nodiscard]] agvd::TriangleMesh shuffle(const agvd::TriangleMesh& mesh);
//! Above 0 for a closed mesh with outward normals.
[[nodiscard]] double signed_volume(const agvd::TriangleMesh& mesh);
[[nodiscard]] agvd::TriangleMesh moved(agvd::TriangleMesh mesh, const agvd::Vec3& by);
//! Length of the longest edge.
[[nodiscard]] double longest_edge(const agvd::Surface& surface);
//! Two meshes side by side in one.
[[nodiscard]] agvd::TriangleMesh join(const agvd::TriangleMesh& a, const agvd::TriangleMesh& b);

}  // namespace shapes
