//! \file
//! The geodesic length of each edge of the dual. Private to the dual.
#pragma once

#include "remesh/dual/flippable_mesh.h"
#include "remesh/dual/site_paths.h"
#include "remesh/dual/straighten.h"

namespace remesh {

//! The path that an edge stands for.
struct EdgePath {
    agvd::Index from = agvd::no_index;  //!< The vertex at its source; no_index: no path yet.
    FaceStrip strip{};
    double length = 0;
    bool is_locally_shortest = false;
};

//! For each edge of `mesh` a locally shortest path: straightened from
//! the one through the nearest point of the Voronoi edge between both sites; for edges without
//! one (diagonals, edges that someone flipped or collapsed into place) from the paths along the
//! other two edges of a triangle.
//!
//! \param num_threads  >= 0; 0: all cores. Same result for any number.
//! Cost: O(size of the complex + faces crossed).
[[nodiscard]] std::vector<EdgePath> find_edge_paths(const agvd::Surface& surface,
                                                    const DualVertices& vertices,
                                                    const FlippableMesh& mesh, int num_threads,
                                                    agvd::Poller& poller);

//! The path straightened from the way along two sides of the quad around an inner edge, from the
//! corner opposite its first side to the other one; the shorter way of the two.
[[nodiscard]] EdgePath path_across(const agvd::Surface& surface, const FlippableMesh& mesh,
                                   const std::vector<EdgePath>& paths, agvd::Index edge,
                                   PathStraightener& straightener);

//! No side of a triangle is longer than the other two, up to rounding.
[[nodiscard]] bool is_triangle(double a, double b, double c);

//! Replaces sides that are longer than the way along the other two of their triangle by the path
//! straightened from that way, in passes over the triangles until all are sound (or 100).
void mend_triangles(const agvd::Surface& surface, const FlippableMesh& mesh, agvd::Ticker ticker,
                    std::vector<EdgePath>& paths);

}  // namespace remesh
