//! \file
//! Turns any triangle soup into oriented 2-manifold pieces, and tells what it did.
#pragma once

#include <string>

#include "agvd/mesh/mesh_view.h"

namespace remesh {

//! How many elements each step of the repair touched.
struct CleanCounts {
    agvd::Index welded_vertices = 0;        //!< Merged into another vertex at the same position.
    agvd::Index degenerate_faces = 0;       //!< Dropped: repeated corner, or no area.
    agvd::Index duplicate_faces = 0;        //!< Dropped: same three corners as an earlier face.
    agvd::Index flipped_faces = 0;          //!< Turned over for a consistent orientation.
    agvd::Index split_edges = 0;            //!< Non-manifold edges cut apart.
    agvd::Index split_vertices = 0;         //!< Non-manifold vertices cut apart.
    agvd::Index isolated_vertices = 0;      //!< Dropped: in no face.

    [[nodiscard]] bool operator==(const CleanCounts&) const = default;
};

struct CleanResult {
    agvd::TriangleMesh mesh;                //!< Every edge and vertex manifold, oriented.
    std::vector<agvd::Index> vertex_origin; //!< #V: the input vertex each vertex came from.
    std::vector<agvd::Index> face_origin;   //!< #F: the input face each face came from.
    CleanCounts counts;
};

//! Repairs in this order: exact duplicate positions are welded where that closes cracks (all of
//! them when the mesh is a soup), degenerate and duplicate faces dropped, faces oriented alike,
//! non-manifold edges and vertices split, isolated vertices dropped. An input without defects comes
//! back unchanged, bit for bit and in the same order.
//!
//! \throw agvd::InvalidInput  an index is out of range, a coordinate is not finite (both name the
//!        element), no face is left, or a component is not orientable.
//! Cost: O(n log n).
[[nodiscard]] CleanResult clean_input(const agvd::MeshView& mesh);

}  // namespace remesh
