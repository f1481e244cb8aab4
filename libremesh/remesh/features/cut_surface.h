//! \file
//! A surface cut along a network of curves.
#pragma once

#include <span>
#include <vector>

#include "agvd/mesh/surface.h"

namespace remesh {

struct CutSurface {
    //! Faces and half-edges have their numbers of before, so that points keep their names; vertices
    //! on curves have a copy for each wedge between these, the first one under the old number.
    agvd::Surface surface;
    std::vector<agvd::Index> original;  //!< #V: the vertex that each is a copy of.
    agvd::Index num_original = 0;       //!< Vertices of the surface before: their own copies.
};

//! The edges become boundary edges on both sides.
//!
//! \param is_cut  #E: 1 for edges to cut; boundary edges may be among them.
//! \param num_threads  >= 0; 0: all cores. The same for any number.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n).
[[nodiscard]] CutSurface cut_surface(const agvd::Surface& surface,
                                     std::span<const std::uint8_t> is_cut, int num_threads = 0,
                                     const agvd::Progress& progress = {});

}  // namespace remesh
