//! \file
//! Cells are connected: a geodesic to the nearest site stays in its cell. Approximate distances may
//! break that where two sites nearly tie; here it is mended.
#pragma once

#include "agvd/diagram/face_arcs.h"
#include "agvd/mesh/surface_point.h"

namespace agvd {

//! By point, the next in a forest: points in one tree hang together along edges and cuts that have
//! no row, whatever becomes of the rows' crossings. Cost: nearly linear in #V + #E.
[[nodiscard]] std::vector<Index> join_points(const Surface& surface, const EdgeLabels& labels);

//! Finds the parts of cells that do not hang together with their site and gives each to a cell that
//! it borders on. The labels then say so; `is_stale` (by position in mixed_faces) is set for the
//! faces around changed edges and cuts, which are to be traced again. Returns the number of parts.
//! Label changes only vanish, so that calling it again and again comes to an end.
//! Cost: nearly linear in the points and crossings.
//! \param joined_points  of join_points for these labels, as they were before any call.
[[nodiscard]] Index absorb_islands(const Surface& surface, std::span<const SurfacePoint> sites,
                                   std::span<const FaceArcs> chunks,
                                   const std::vector<Index>& joined_points, EdgeLabels& labels,
                                   std::vector<std::uint8_t>& is_stale);

}  // namespace agvd
