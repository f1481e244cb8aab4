//! \file
//! The farthest Voronoi vertex of each cell.
#pragma once

#include "agvd/diagram/diagram.h"

namespace remesh {

//! #sites: for each cell its Voronoi vertex farthest from the site (the first of equals); no_index
//! for cells without one. Cost: O(size of the complex).
[[nodiscard]] std::vector<agvd::Index> farthest_voronoi_vertices(const agvd::Diagram& diagram);

}  // namespace remesh
