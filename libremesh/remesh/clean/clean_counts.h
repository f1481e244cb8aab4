//! \file
//! What the repair of an input did.
#pragma once

#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh {

//! How many elements each step of the repair touched.
struct CleanCounts {
    Index welded_vertices = 0;   //!< Merged into another vertex at the same place.
    Index degenerate_faces = 0;  //!< Dropped: repeated corner, or no area.
    Index absorbed_faces = 0;    //!< Without area, removed by an edge flip: no hole is left.
    Index duplicate_faces = 0;   //!< Dropped: same three corners as an earlier face.
    //! Kept: same three corners as an earlier face, but oriented the other way; two bodies touch.
    Index touching_faces = 0;
    Index flipped_faces = 0;      //!< Turned over for a consistent orientation.
    Index split_edges = 0;        //!< Edges of more than two faces, cut apart.
    Index split_vertices = 0;     //!< Copies made where faces at a vertex are not one fan.
    Index filled_holes = 0;       //!< Boundary loops closed: CleanOptions::fill_holes.
    Index isolated_vertices = 0;  //!< Dropped: in no face, or only in dropped ones.

    //! Whether all counts are equal.
    [[nodiscard]] bool operator==(const CleanCounts&) const = default;
};

}  // namespace remesh
