//! \file
//! Cells are connected: a geodesic to the nearest site stays in its cell. Approximate distances may
//! break that where two sites nearly tie; here it is mended.
#pragma once

#include "agvd/diagram/cell_set.h"
#include "agvd/mesh/surface_point.h"

namespace agvd {

//! What the label of a point was.
struct OldLabel {
    Index point;
    Index site;
};

//! Finds the parts of cells that do not hang together with their site and gives each to a cell that
//! it borders on. The labels then say so. Calling it again and again comes to an end, since label
//! changes only vanish.
//! Cost: nearly linear in the points and crossings of those faces, and O(#V).
//! \param faces        all that the cells asked for reach into.
//! \param asked        the cells that may have such parts. After the call: those that had some, even
//!                     if nobody could take them.
//! \param old_labels   the points whose label changes are appended, with their old labels.
//! \param stale_faces  the faces around changed labels are appended, which are to be traced again;
//!                     maybe some of them twice.
//! \return the number of parts.
[[nodiscard]] Index absorb_islands(const Surface& surface, std::span<const SurfacePoint> sites,
                                   const ArcStore& arcs, const FaceList& faces,
                                   EdgeLabels& labels, CellSet& asked,
                                   std::vector<OldLabel>& old_labels,
                                   std::vector<Index>& stale_faces);

}  // namespace agvd
