//! \file
//! Traces and joins the arcs of the faces that a change touches.
#pragma once

#include "agvd/update/kept_diagram.h"
#include "agvd/update/touched_parts.h"

namespace agvd {

//! Replaces the cuts and arcs that do not hold, and joins the new arcs.
//! \param touched  its edges are settled.
//! \return ascending: the faces whose arcs were taken away, some of which have none now.
std::vector<Index> update_arcs(const StageInput& input, const TouchedParts& touched,
                               DiagramParts& parts);

//! Brings the list of Voronoi vertices up to date.
//! \param faces  in any order: all that lost or got arcs.
void update_voronoi_vertices(const ArcStore& arcs, std::vector<Index> faces,
                             std::vector<FaceVoronoiVertices>& voronoi_vertices);

}  // namespace agvd
