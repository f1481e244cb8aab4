//! \file
//! A surface cut along a network of curves.
#pragma once

#include <span>
#include <vector>

#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh {

struct CutSurface {
    //! Faces and half-edges keep their numbers, so surface points stay valid. A vertex on curves
    //! has a copy for each wedge between them; the first copy keeps the old number.
    Surface surface;
    std::vector<Index> original;  //!< #V: the vertex that each is a copy of.
    Index num_original = 0;       //!< Vertices before the cut, their own originals.
};

//! Cuts a surface along edges, which become boundary edges on both sides.
//!
//! \param is_cut  #E: 1 for edges to cut; boundary edges may be among them.
//! \param num_threads  >= 0; 0: all cores. The result is the same for any number.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n).
[[nodiscard]] CutSurface cut_surface(const Surface& surface, std::span<const std::uint8_t> is_cut,
                                     int num_threads = 0, const Progress& progress = {});

}  // namespace remesh
