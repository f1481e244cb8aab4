//! \file
//! Joins the arcs of all faces into Voronoi edges, and the boundary into arcs between them.
#pragma once

#include "agvd/diagram/diagram.h"
#include "agvd/diagram/face_arcs.h"

namespace agvd {

//! Fills points, edges and vertices of `diagram` from the chunks' arcs, in order. Branches become
//! the first Voronoi vertices, then the label changes on the boundary.
//! Cost: O(size of the complex + boundary).
void join_arcs(const Surface& surface, const EdgeLabels& labels, std::span<const FaceArcs> chunks,
               Diagram& diagram);

}  // namespace agvd
