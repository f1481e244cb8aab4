//! \file
//! Joins the patches of a mesh that was cut along curves: closes their rims, glues them, and welds
//! sheets. Private to remeshing.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "agvd/mesh/any_mesh.h"
#include "remesh/names.h"

namespace remesh {

//! A mesh of which some vertices were made one.
struct GluedMesh {
    std::vector<Triangle> triangles;  //!< In the given order; corners are glued vertices.
    std::vector<Index> vertex;        //!< Of each given vertex: the glued one.
    std::vector<Index> first;         //!< Of each glued vertex: the first given one.
};

//! Makes the vertices of a group one. Cost: O(n).
//! \param group  #V: equal for those that become one vertex.
[[nodiscard]] GluedMesh glue(std::span<const Triangle> triangles, std::span<const Index> group);

//! By element: the first one of its group. Cost: O(n).
//! \param group  equal for the elements of a group.
[[nodiscard]] std::vector<Index> first_of_groups(std::span<const Index> group);

//! The two sides of an inner edge of a patch.
struct InnerEdge {
    Index half_edge, other;  //!< 3 t + k: from corner k of triangle t to the next one.
};

//! Inner edges of patches that would coincide with other edges if the patches were glued: all but
//! one at each place, or all if rims of patches meet there.
//! \param group  #V, as for glue(). Cost: O(n log n).
[[nodiscard]] std::vector<InnerEdge> repeated_edges(std::span<const Triangle> patches,
                                                    std::span<const Index> group);

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

//! The same for edges that would have more than two faces, or equal ends.
//! \param group  #V, as for glue().
bool flip_repeated(std::vector<Triangle>& triangles, std::span<const Index> group);

using DirectedEdge = std::pair<Index, Index>;  //!< From, to.

//! Whether ascending edges hold one, in either direction. Cost: O(log n).
[[nodiscard]] inline bool has_edge(std::span<const DirectedEdge> sorted, Index a, Index b) {
    return std::ranges::binary_search(sorted, DirectedEdge(a, b)) ||
           std::ranges::binary_search(sorted, DirectedEdge(b, a));
}

//! The sides without a triangle on their right, ascending. Their own triangle lies on their left.
//! Cost: O(n log n).
[[nodiscard]] std::vector<DirectedEdge> rim_of(std::span<const Triangle> triangles);

//! Fills gaps between chain and rim with triangles, without a change of topology: where the cell of
//! an inner site meets a curve, the rim passes through that site; where a site of the curve (at a
//! sharp corner) has no triangle, the rim bypasses it.
//! \param chain  edges that the rim is to have.
//! Cost: O(n log n).
void close_rim(std::span<const DirectedEdge> chain, std::vector<Triangle>& triangles);

//! The number of edges with more than two faces. Cost: O(n).
[[nodiscard]] Index num_branched_edges(std::span<const Triangle> triangles);

}  // namespace remesh
