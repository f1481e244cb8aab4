//! \file
//! Chooses the creases that a mesh of a spacing can have. Private to remeshing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh {

//! Creases that run much closer to each other, or to the boundary, than the sites would be: the
//! heavier one stays (length times angle), and the pieces of the other that are too close go. What
//! then dangles goes as well, and so do closed chains of a few spacings. Where curves meet they may
//! be close.
//! \param spacing    of the sites, mesh units.
//! \param is_fixed   #E: creases that stay in any case; empty: none.
//! \param is_crease  #E; edited in place.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(#E + length of the creases / spacing), k log k for k chains.
void select_creases(const Surface& surface, double spacing, std::span<const std::uint8_t> is_fixed,
                    int num_threads, const Progress& progress,
                    std::vector<std::uint8_t>& is_crease);

}  // namespace remesh
