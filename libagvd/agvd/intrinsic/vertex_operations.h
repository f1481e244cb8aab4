//! \file
//! Vertices inserted into faces and taken out of them, in place. What goes leaves gaps: faces whose
//! corners are no_index, edges whose edge_half and vertices whose outgoing is. Private to
//! intrinsic.
#pragma once

#include "agvd/intrinsic/face_charts.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace agvd::detail {

//! Makes a gap of a face.
void bury(Surface& surface, Index face);

//! Lays a face out anew after its lengths have changed. Where they make no triangle, it gets the
//! least height.
void renew_face(Surface& surface, FaceCharts& charts, Index face);

//! Cuts face (a, b, c) into (a, b, m), and the new faces (b, c, m) and (c, a, m).
//! \param where  barycentric coordinates of m, > 0.
//! \param vertex  m: without faces.
void insert_in_face(Surface& surface, FaceCharts& charts, Index face,
                    const std::array<double, 3>& where, Index vertex);

//! Takes an inner vertex of three edges away: its three faces become one, the first of them.
//! \param half_edge  leaves the vertex.
void remove_from_face(Surface& surface, FaceCharts& charts, Index half_edge);

//! Takes a vertex of the boundary away that has two faces: they become one, whose boundary edge is
//! as long as two.
//! \param half_edge  leaves the vertex along the boundary.
//! \param length     of the new edge.
void remove_from_boundary(Surface& surface, FaceCharts& charts, Index half_edge, double length);

//! Takes a vertex with a single face away, and that face, whose third edge is not on the boundary.
//! \param half_edge  leaves the vertex along the boundary.
void remove_ear(Surface& surface, Index half_edge);

}  // namespace agvd::detail
