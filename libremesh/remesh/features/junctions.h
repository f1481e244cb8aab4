//! \file
//! Where sheets met in the mesh that a surface was cleaned from.
#pragma once

#include <span>
#include <vector>

#include "agvd/mesh/surface.h"

namespace remesh {

//! What becomes of edges that more than two faces share in the input.
enum class Junctions {
    Apart,  //!< Each sheet has vertices of its own there, at the same points.
    Keep    //!< The sheets are welded again: the result is no more manifold there than the input.
};

//! Lower-case name of a choice: "apart" or "keep".
[[nodiscard]] const char* junctions_name(Junctions junctions);

//! Elements of a surface that were one before cleaning cut the sheets apart.
struct JunctionSet {
    std::vector<std::vector<agvd::Index>> edges;  //!< Two or more each, ascending.
    //! The same of the ends of such edges. Vertices that met in nothing but a point are not in it.
    std::vector<std::vector<agvd::Index>> vertices;
    Junctions in_result = Junctions::Apart;

    [[nodiscard]] bool empty() const { return edges.empty(); }
};

//! Edges whose ends have the same origins were one edge: places do not count.
//!
//! \param vertex_origin  #V: see CleanResult; empty: each is its own.
//! Cost: O(#V + #E + k log k), k = edges at vertices of which there are copies.
[[nodiscard]] JunctionSet find_junctions(const agvd::Surface& surface,
                                         std::span<const agvd::Index> vertex_origin);

//! Takes out what hangs together and is shorter, mesh units. Cost: O(#V + k), k = edges of
//! junctions.
void drop_short_junctions(const agvd::Surface& surface, double least_length,
                          JunctionSet& junctions);

//! #V: the first of the vertices that are one at a junction; of the others the vertex itself.
[[nodiscard]] std::vector<agvd::Index> first_copies(const JunctionSet& junctions,
                                                    agvd::Index num_vertices);

}  // namespace remesh
