//! \file
//! Remeshes a part of a mesh: takes it out, and joins it with the faces that stay.
#pragma once

#include <algorithm>

#include "agvd/mesh/any_mesh.h"
#include "remesh/pipeline/remesh.h"

namespace remesh::detail {

//! A vertex at the position of a kept face's corner and of a remeshed face's.
struct RimVertex {
    Index vertex;  //!< Of the region's mesh: the first one there.
    //! The caller's vertex that kept and remeshed faces share; no_index: they only touch.
    Index shared;
};

//! Some faces of the caller's mesh as a mesh of its own.
struct MeshPart {
    TriangleMesh mesh;
    std::vector<Index> vertices;  //!< #V of mesh: the caller's, ascending.
    std::vector<Index> faces;     //!< #F of mesh: likewise.
    std::vector<Index> number;    //!< By vertex of the caller: that of mesh, or no_index.
};

//! \param faces  ascending. Cost: O(n).
[[nodiscard]] MeshPart take_faces(const MeshView& mesh, std::vector<Index> faces, Ticker& ticker);

//! The faces to remesh.
struct Region : MeshPart {
    std::vector<Index> kept;     //!< All other faces of the caller, ascending.
    std::vector<RimVertex> rim;  //!< By position; ascending.
    //! Edges between remeshed and kept faces, as vertices of mesh.
    std::vector<std::array<Index, 2>> rim_edges;
    //! Edges between vertices of the rim that have more than two faces, all of them remeshed.
    std::vector<std::array<Index, 2>> branched_edges;
};

//! Divides a mesh into the faces to remesh and those that stay. Vertices at equal positions count
//! as one, as the mesh may not be welded. Marked faces without area are left to cleaning, which
//! absorbs them. They stay where it would drop them instead, and with them an edge or a vertex of
//! the rim: where a vertex inside the region lies on an edge of the rim.
//! \param is_marked  #F: other than 0 for the faces to remesh.
//! \param cleaning   of the region.
//! \throw InvalidOption  no face is left to remesh.
//! \throw InvalidInput   an index is out of range, or a coordinate is not finite; that of
//!                       clean_input() if marked faces are without area.
//! Cost: O(n log n), for each of few rounds if marked faces are without area.
[[nodiscard]] Region cut_region(const MeshView& mesh, std::span<const std::uint8_t> is_marked,
                                const CleanOptions& cleaning);

//! Whether there is an edge with this edge_key.
//! \param sides  sorted_edge_sides().
[[nodiscard]] inline bool has_sides(const std::vector<EdgeSide>& sides, std::uint64_t ends) {
    return std::ranges::binary_search(sides, ends, {}, &EdgeSide::ends);
}

struct GluedRegion {
    TriangleMesh mesh;                 //!< Kept vertices and faces first.
    std::vector<Index> kept_vertices;  //!< The caller's vertices that come first, ascending.
    std::vector<Index> vertex;         //!< #V of the remeshed region: its vertex in mesh.
};

//! Joins a remeshed region and the faces that stayed, so that no edge has more faces than in the
//! input. For that it flips inner edges of the region between vertices that another edge joins.
//! \param remeshed  has all vertices and edges of the region's rim, at their positions.
//! \throw ConstraintUnmet  that is not possible.
//! Cost: O(n log n).
[[nodiscard]] GluedRegion glue_region(const MeshView& mesh, const Region& region,
                                      const TriangleMesh& remeshed, Ticker& ticker);

//! Takes the region out as a mesh of its own, locks its rim, remeshes it, and joins it with the
//! faces that stay.
//! \param options  with a region; checked.
//! \throw as remesh().
//! Cost: O(n log n) for the whole mesh, and that of remesh() for the region.
[[nodiscard]] RemeshResult remesh_region(const MeshView& mesh, const RemeshOptions& options);

}  // namespace remesh::detail
