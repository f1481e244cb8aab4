//! \file
//! A coarse mesh in place of one that is much finer than the result will be: its vertices are some
//! of the input's, its topology and its curves are those of the input. Held by Coarsen in
//! tests/remesh/clean.
#pragma once

#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh {

struct CoarsenOptions {
    Index num_faces = 0;       //!< Ends as soon as there are no more than these.
    double longest_edge = 0;   //!< Mesh units: no longer edges are made.
    double most_distance = 0;  //!< Mesh units: of the planes of the faces around a vertex from
                               //!< where it goes, root mean square.
    int num_threads = 0;       //!< >= 0; 0: all cores. The result is the same for any number.
    Progress progress = {};
};

struct CoarseMesh {
    TriangleMesh mesh;
    std::vector<Index> vertex_origin;  //!< #V, ascending: which vertex of the surface it is.
    std::vector<std::uint8_t> mark;    //!< #H: that of the edge of the surface that it follows.
};

//! Collapses edges, cheapest first, by the squared distances from the planes of the input's faces
//! ([garland1997]). A vertex is removed by an edge to a neighbour, which stays where it is.
//! Topology is kept by the link condition ([dey1999]), and no face turns by more than 75 degrees in
//! one step.
//! \param mark   #E: not 0 for edges of curves. A vertex with two edges of one mark moves only along
//!        them, one with others stays. The boundary is such a curve as well.
//! \param stays  #V: 1 for vertices that stay; empty: none.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(#F), some 2 microseconds a face.
[[nodiscard]] CoarseMesh coarsen(const Surface& surface, std::span<const std::uint8_t> mark,
                                 std::span<const std::uint8_t> stays,
                                 const CoarsenOptions& options);

}  // namespace remesh
