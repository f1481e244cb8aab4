//! \file
//! The pieces of Voronoi edges within faces.
#pragma once

#include "agvd/diagram/diagram.h"

namespace agvd {

//! A straight piece of a curve, both ends as points of the face that it crosses.
struct CurvePiece {
    SurfacePoint from;  //!< First end.
    SurfacePoint to;    //!< Other end; in the same face.
};

//! The piece of a Voronoi edge, or of an arc of the boundary, from one of its points to the next.
//! \param point  index in diagram.points, not the last one of an edge that is open.
[[nodiscard]] CurvePiece curve_piece(const Surface& surface, const Diagram& diagram, Index edge,
                                     Index point);

//! Mesh units, within the faces; of a closed curve without its last piece.
//! Cost: O(points of the edge).
[[nodiscard]] double curve_length(const Surface& surface, const Diagram& diagram, Index edge);

}  // namespace agvd
