//! \file
//! A surface cut open along edges that no path crosses.
//! Held by CutSurface in tests/agvd/mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"

namespace agvd {

//! What is left after a cut.
struct OpenedSurface {
    Surface surface;              //!< With a boundary along the cuts.
    std::vector<Index> original;  //!< #V: the vertex of the whole that each is a copy of.
};

//! Cuts a surface along edges, which become boundary edges on both sides. Faces and half-edges keep
//! their numbers, so that points on the surface stay valid: one on a cut is on the side of its
//! face. A vertex has a copy for each wedge between cuts; the first copy keeps the old number, the
//! others come behind all vertices.
//!
//! \param is_cut       #E: 1 for edges to cut; boundary edges may be among them.
//! \param num_threads  >= 0; 0: all cores. The result is the same for any number.
//! \throw InvalidOption  is_cut has not one entry for each edge.
//! \throw Cancelled      the progress callback returned false.
//! Cost: O(n).
[[nodiscard]] OpenedSurface cut_along(const Surface& surface, std::span<const std::uint8_t> is_cut,
                                      int num_threads = 0, const Progress& progress = {});

}  // namespace agvd
