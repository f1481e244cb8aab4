//! \file
//! Cells are connected: a geodesic to the nearest site stays in its cell. Approximate distances may
//! break that where two sites nearly tie; here it is mended.
#pragma once

#include "agvd/diagram/face_arcs.h"
#include "agvd/mesh/surface_point.h"

namespace agvd {

//! Finds the parts of cells that do not hang together with their site and gives each to a cell that
//! it borders on. The labels then say so; `is_stale` (by position in mixed_faces) is set for the
//! faces around changed edges and cuts, which are to be traced again. Returns the number of parts.
//! Label changes only vanish, so that calling it again and again comes to an end.
//! Cost: O(#V + #E) and nearly linear in the crossings.
[[nodiscard]] Index absorb_islands(const Surface& surface, std::span<const SurfacePoint> sites,
                                   std::span<const FaceArcs> chunks, EdgeLabels& labels,
                                   std::vector<std::uint8_t>& is_stale);

}  // namespace agvd
