//! \file
//! Divides a mesh into the faces to remesh and those that stay.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "remesh/clean/clean_input.h"

namespace remesh::detail {

//! A vertex at the position of a kept face's corner and of a remeshed face's.
struct SeamVertex {
    Index vertex;  //!< Of the region's mesh: the first one there.
    //! The caller's vertex that kept and remeshed faces share; no_index: they only touch.
    Index shared;
};

struct Region {
    TriangleMesh mesh;             //!< The faces to remesh.
    std::vector<Index> vertices;   //!< #V of mesh: the caller's, ascending.
    std::vector<Index> faces;      //!< #F of mesh: likewise.
    std::vector<Index> kept;       //!< All other faces of the caller, ascending.
    std::vector<SeamVertex> seam;  //!< By position; ascending.
    //! Edges between remeshed and kept faces, as vertices of mesh.
    std::vector<std::array<Index, 2>> seam_edges;
    //! Edges between vertices of the seam that have more than two faces, all of them remeshed.
    std::vector<std::array<Index, 2>> branched_edges;
};

//! Vertices at equal positions count as one, so that the seam is found in meshes that are not
//! welded as well. Marked faces without area are left to cleaning, which absorbs them. They stay
//! where it would drop them instead, and with them an edge or a vertex of the seam: where a vertex
//! inside the region lies on an edge of the seam.
//!
//! \param is_marked  #F: other than 0 for the faces to remesh.
//! \param cleaning   of the region.
//! \throw InvalidOption  no face is left to remesh.
//! \throw InvalidInput   an index is out of range, or a coordinate is not finite; that of
//!                             clean_input() if marked faces are without area.
//! Cost: O(n log n), for each of few rounds if marked faces are without area.
[[nodiscard]] Region cut_region(const MeshView& mesh, std::span<const std::uint8_t> is_marked,
                                const CleanOptions& cleaning);

}  // namespace remesh::detail
