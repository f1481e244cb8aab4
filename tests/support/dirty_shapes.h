//! \file
//! Meshes with defects, by formula.
#pragma once

#include <optional>

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"

namespace shapes {

//! Every face with three vertices of its own, as in an STL file.
[[nodiscard]] agvd::TriangleMesh unweld(const agvd::TriangleMesh& mesh);
//! One-sided strip of 2 n faces, n >= 3.
[[nodiscard]] agvd::TriangleMesh moebius(agvd::Index n);
//! `pages` rectangles of two faces that share the edge 0-1 on the z axis, evenly around it.
[[nodiscard]] agvd::TriangleMesh book(agvd::Index pages);
//! Two tetrahedra with one vertex in common.
[[nodiscard]] agvd::TriangleMesh hourglass();
//! Two unit cubes that share one edge (both its vertices, four faces).
[[nodiscard]] agvd::TriangleMesh cubes_on_an_edge();
//! Unit square whose lower half has the middle edge whole, its upper half in `n` pieces; n - 1
//! faces without area fill the slit.
[[nodiscard]] agvd::TriangleMesh filled_slit(agvd::Index n);
//! shapes::grid(n), n even, with a slit along y = 1/2 from x = begin / n to end / n, 0 <= begin <
//! end
//! <= n. The sides coincide; tips inside the square are one vertex.
[[nodiscard]] agvd::TriangleMesh slit_grid(agvd::Index n, agvd::Index begin, agvd::Index end);
//! Reproducible damage to any mesh: faces turned, repeated and deleted, corners exchanged, vertices
//! doubled, isolated and moved onto others.
[[nodiscard]] agvd::TriangleMesh damage(agvd::TriangleMesh mesh, agvd::Index times,
                                        std::uint64_t seed);
//! Random triangles (repeated corners too) on few vertices of a small lattice.
[[nodiscard]] agvd::TriangleMesh random_soup(agvd::Index vertices, agvd::Index faces,
                                             std::uint64_t seed);

//! A soup of up to 2000 faces, most of them of closed solids: boxes and balls that cross, planes,
//! needles, loose faces with gaps, faces twice and turned over.
[[nodiscard]] agvd::TriangleMesh dirty_solids(std::uint64_t seed);

//! Three quarters of a cube of 48 faces, some of its coordinates times up to 10^most: spikes. With
//! 17 their width is a rounding of their length.
[[nodiscard]] agvd::TriangleMesh spiked(std::uint64_t seed, agvd::Index most = 17);
//! It as a surface; none if a face has no area.
[[nodiscard]] std::optional<agvd::Surface> spiked_surface(std::uint64_t seed);

}  // namespace shapes
