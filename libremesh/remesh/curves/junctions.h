//! \file
//! Junctions: where sheets met in the input before cleaning cut them apart.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh {

//! What the result does with edges that have more than two faces in the input.
enum class Junctions {
    Apart,  //!< Each sheet has vertices of its own there, at the same points.
    Keep    //!< The sheets are welded again: the result is non-manifold there, like the input.
};

//! Lower-case name of a choice: "apart" or "keep".
[[nodiscard]] const char* junctions_name(Junctions junctions);

//! Copies: elements of a surface that were one before cleaning cut the sheets apart.
struct JunctionSet {
    std::vector<std::vector<Index>> edges;  //!< Two or more each, ascending.
    //! The same for the ends of such edges. Vertices where sheets met in a single point are left
    //! out.
    std::vector<std::vector<Index>> vertices;
    Junctions in_result = Junctions::Apart;  //!< What becomes of the sheets.

    //! Whether no sheets meet in an edge.
    [[nodiscard]] bool empty() const { return edges.empty(); }
};

//! Finds junctions: edges whose ends have the same origins were one edge. Positions do not count.
//! Edges with the same faces on both sides are left out: they lie inside walls of two bodies.
//!
//! \param vertex_origin  #V: see CleanResult; empty: each vertex is its own.
//! Cost: O(#V + #E + k log k), k = edges at vertices that have copies.
[[nodiscard]] JunctionSet find_junctions(const Surface& surface,
                                         std::span<const Index> vertex_origin);

//! Removes connected junctions shorter than least_length (mesh units). Cost: O(#V + k), k = edges
//! of junctions.
void drop_short_junctions(const Surface& surface, double least_length, JunctionSet& junctions);

//! Creases and the edges of junctions: the surface is cut along those with two faces.
//! \param is_crease  #E. Cost: O(#edges of junctions).
[[nodiscard]] std::vector<std::uint8_t> edges_to_cut(const JunctionSet& junctions,
                                                     std::vector<std::uint8_t> is_crease);

//! #V: the first copy of a vertex at a junction; any other vertex itself.
[[nodiscard]] std::vector<Index> first_copies(const JunctionSet& junctions, Index num_vertices);

}  // namespace remesh
