//! \file
//! The geodesic length of each edge of the dual. Private to the dual.
#pragma once

#include "remesh/dual/flippable_mesh.h"
#include "remesh/dual/site_paths.h"
#include "remesh/dual/straighten.h"

namespace remesh {

//! The path of an edge on the surface.
struct EdgePath {
    Index from = no_index;  //!< The vertex at its source; no_index: no path yet.
    FaceStrip strip{};
    double length = 0;
    bool is_locally_shortest = false;
};

//! Finds a locally shortest path for each edge of `mesh`. It is straightened from the path through
//! the nearest point of the Voronoi edge between both sites. Edges without a Voronoi edge
//! (diagonals, results of flips and collapses) use the paths of the other two edges of a triangle.
//!
//! \param num_threads  >= 0; 0: all cores. Same result for any number.
//! Cost: O(size of the complex + faces crossed).
[[nodiscard]] std::vector<EdgePath> find_edge_paths(const Surface& surface,
                                                    const DualVertices& vertices,
                                                    const FlippableMesh& mesh, int num_threads,
                                                    Poller& poller);

//! The path between the corners opposite an inner edge, from that of its first side to the other.
//! It is straightened from the shorter of the two ways along sides of the quad around the edge.
[[nodiscard]] EdgePath path_across(const Surface& surface, const FlippableMesh& mesh,
                                   const std::vector<EdgePath>& paths, Index edge,
                                   PathStraightener& straightener);

//! Whether no side is longer than the other two together, up to rounding.
[[nodiscard]] bool is_triangle(double a, double b, double c);

//! Replaces a side that is longer than the other two of its triangle together by the path
//! straightened from these. Repeats passes over the triangles until there is no such side, at most
//! 100.
void mend_triangles(const Surface& surface, const FlippableMesh& mesh, Ticker ticker,
                    std::vector<EdgePath>& paths);

}  // namespace remesh
