//! \file
//! Cells are connected: a geodesic to the nearest site stays in its cell. Approximate distances may
//! break that where two sites nearly tie; here it is mended.
#pragma once

#include "agvd/diagram/cell_set.h"
#include "agvd/diagram/cell_tally.h"
#include "agvd/diagram/touched_parts.h"
#include "agvd/mesh/surface_point.h"

namespace agvd {

//! What the label of a point was.
struct OldLabel {
    Index point;
    Index site;
};

//! Finds out for the sites in touched faces whether their place belongs to another cell. Islands
//! that are absorbed change nothing of it.
//! Cost: O(#sites + inner points) quick steps.
void find_displaced(const Surface& surface, std::span<const SurfacePoint> sites,
                    const EdgeLabels& labels, const TouchedParts& touched, CellSet& displaced);

//! The cells that may have parts that do not hang together with their site: all others are bounded
//! by one loop, which each part would need for itself, and own the place of their site.
//! \param num_loops  by site, boundary loops of its cell.
[[nodiscard]] CellSet cells_in_doubt(const CellSet& displaced, std::span<const Index> num_loops);

//! Finds the parts of cells in doubt that do not hang together with their site and gives each to a
//! cell that it borders on. The labels then say so. Calling it again and again comes to an end,
//! since label changes only vanish. Cost: nearly linear in the points and crossings of those faces,
//! and O(#V + crossings) quick steps.
//! \param faces        all that the cells in doubt reach into.
//! \param tally        is told of rows, not of points.
//! \param old_labels   the points whose label changes are appended, with their old labels.
//! \param stale_faces  the faces around changed labels are appended, which are to be traced again;
//!        maybe some of them twice.
//! \return the number of parts.
[[nodiscard]] Index absorb_islands(const Surface& surface, std::span<const SurfacePoint> sites,
                                   const ArcStore& arcs, const CellSet& in_doubt,
                                   std::span<const Index> faces, EdgeLabels& labels,
                                   CellTally& tally, std::vector<OldLabel>& old_labels,
                                   std::vector<Index>& stale_faces);

}  // namespace agvd
