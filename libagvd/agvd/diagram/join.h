//! \file
//! Joins the arcs of all faces into Voronoi edges.
#pragma once

#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/joined_edges.h"

namespace agvd {

//! Takes the edges through a face apart. To be called before the face loses its arcs.
//! Cost: O(arcs of the face).
void forget_arcs(const ArcStore& arcs, Index face, JoinedEdges& joined);

//! Joins new arcs with each other and with those of edges that were taken apart. Keys, and so the
//! order of the edges, do not depend on what was joined before: open edges come in the order of the
//! first of their ends in the faces, then closed ones in that of their first tail.
//!
//! \param new_faces  ascending: those that got their arcs since the last call.
//! \throw Cancelled  `joined` is of no use any more.
//! Cost: O(arcs of the new edges + edges).
void join_arcs(const EdgeLabels& labels, const ArcStore& arcs, std::span<const Index> new_faces,
               Ticker ticker, JoinedEdges& joined);

}  // namespace agvd
