//! \file
//! Inserts vertices into faces and removes them, in place. Removed elements leave gaps: faces whose
//! corners are no_index, edges whose edge_half is no_index, vertices whose outgoing is no_index.
//! Private to intrinsic.
#pragma once

#include "agvd/intrinsic/face_charts.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace agvd::detail {

//! Makes a gap of a face.
void bury(Surface& surface, Index face);

//! Computes the layout of a face after its lengths have changed. If they make no triangle, it gets
//! the least height.
void renew_face(Surface& surface, FaceCharts& charts, Index face);

//! Cuts face (a, b, c) into (a, b, m), and the new faces (b, c, m) and (c, a, m).
//! \param where  barycentric coordinates of m, > 0.
//! \param vertex  m, which has no faces.
void insert_in_face(Surface& surface, FaceCharts& charts, Index face,
                    const std::array<double, 3>& where, Index vertex);

//! Removes an inner vertex of three edges: its three faces become one, the first of them.
//! \param half_edge  leaves the vertex.
void remove_from_face(Surface& surface, FaceCharts& charts, Index half_edge);

//! Removes a vertex of the boundary that has two faces. They become one, whose boundary edge
//! replaces the two at the vertex.
//! \param half_edge  leaves the vertex along the boundary.
//! \param length     of the new edge.
void remove_from_boundary(Surface& surface, FaceCharts& charts, Index half_edge, double length);

//! Removes a vertex with a single face, and that face. The third edge of the face is not on the
//! boundary.
//! \param half_edge  leaves the vertex along the boundary.
void remove_ear(Surface& surface, Index half_edge);

}  // namespace agvd::detail
