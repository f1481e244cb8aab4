//! \file
//! Joins the patches of a mesh that was cut along curves: closes their rims, glues them, and welds
//! sheets. Private to remeshing.
#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "agvd/mesh/any_mesh.h"
#include "remesh/names.h"

namespace remesh {

struct GluedMesh {
    std::vector<Triangle> triangles;    //!< In the given order; corners are glued vertices.
    std::vector<Triangle> in_patches;   //!< The same before that: corners are given vertices.
    std::vector<Index> vertex;          //!< Of each given vertex: the glued one.
    std::vector<Index> representative;  //!< Of each glued vertex: the first given one.
    //! Of each glued vertex: the first given vertex of its group. Equal for vertices of different
    //! sheets at one position.
    std::vector<Index> first_of_group;
};

//! Makes the vertices of a group one. An inner edge of a patch that joins the same groups as an
//! edge of another patch is flipped if possible: the glued edge would have more than two faces.
//! \param group   #V: equal for copies at one position. Two groups are to have at most one edge.
//! \param vertex  #V: equal for the copies of a group that become one vertex; empty: all of them.
//! Cost: O(n log n).
[[nodiscard]] GluedMesh glue(std::span<const Triangle> triangles, std::span<const Index> group,
                             std::span<const Index> vertex = {});

//! The two sides of an inner edge of a patch.
struct InnerEdge {
    Index half_edge, other;  //!< 3 t + k: from corner k of triangle t to the next one.
};

//! Inner edges of patches that coincide with other edges of the glued mesh: all but one at each
//! place, or all if rims of patches meet there.
[[nodiscard]] std::vector<InnerEdge> repeated_edges(const GluedMesh& mesh);

//! Flips inner edges of patches, so that fewer edges of the glued mesh are repeated: in rounds of
//! one flip for each repeated edge, as a flip can cause another repetition.
//! \param triangles    edited in place.
//! \param vertex       #V: the vertex of the glued mesh.
//! \param is_repeated  tells of the sides of an edge of the glued mesh whether there are too many.
//! \param is_taken     tells whether further faces have an edge, by its edge_key.
//! \return whether none is repeated any more. Cost: O(n log n).
bool flip_repeated(std::vector<Triangle>& triangles, std::span<const Index> vertex,
                   const std::function<bool(std::span<const EdgeSide>)>& is_repeated,
                   const std::function<bool(std::uint64_t)>& is_taken);

using DirectedEdge = std::pair<Index, Index>;  //!< From, to.

//! The sides without a triangle on their right, ascending. Their own triangle lies on their left.
//! Cost: O(n log n).
[[nodiscard]] std::vector<DirectedEdge> rim_of(std::span<const Triangle> triangles);

//! Fills gaps between chain and rim with triangles, without a change of topology: where the cell of
//! an inner site meets a curve, the rim passes through that site; where a site of the curve (at a
//! sharp corner) has no triangle, the rim bypasses it.
//! \param chain  edges that the rim is to have.
//! Cost: O(n log n).
void close_rim(std::span<const DirectedEdge> chain, std::vector<Triangle>& triangles);

//! Merges the vertices of each group into the first one.
//! \param group  #V.
//! \return the vertices that stay, ascending; these are the new vertices in order. Cost: O(n).
std::vector<Index> weld_sheets(std::span<const Index> group, TriangleMesh& mesh);

//! The number of edges with more than two faces. Cost: O(n).
[[nodiscard]] Index num_branched_edges(std::span<const Triangle> triangles);

}  // namespace remesh
