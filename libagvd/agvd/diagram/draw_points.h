//! \file
//! The geometric half of drawing: where Voronoi edges and vertices lie.
#pragma once

#include "agvd/diagram/draw_complex.h"

namespace agvd {

//! Removes all points and edge_points of `diagram` and makes room for new ones.
void clear_points(const DrawingInput& input, Diagram& diagram);

//! Appends the points of a Voronoi edge. The edges come in the order of draw_complex().
//! \param name  in JoinedEdges.
void draw_edge(const DrawingInput& input, Index name, Ticker& ticker, Diagram& diagram);

//! Appends the points of the edges on the surface's boundary, which follow all others.
void draw_boundary(const DrawingInput& input, Diagram& diagram);

//! Sets the places and distances of the vertices.
void draw_vertices(const DrawingInput& input, Diagram& diagram);

}  // namespace agvd
