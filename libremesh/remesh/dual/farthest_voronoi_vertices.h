//! \file
//! The farthest Voronoi vertex of each cell: a place for another site.
#pragma once

#include <vector>

#include "agvd/diagram/diagram.h"
#include "remesh/names.h"

namespace remesh {

//! #sites: for each cell its Voronoi vertex farthest from the site (the first of equals); no_index
//! for cells without one. Cost: O(size of the complex).
[[nodiscard]] std::vector<Index> farthest_voronoi_vertices(const Diagram& diagram);

//! The farthest Voronoi vertices of the largest cells, the largest cell first, each once.
//!
//! \param count  at most so many.
//! Cost: O(size of the complex + #sites log #sites).
[[nodiscard]] std::vector<Index> places_in_largest_cells(const Diagram& diagram, std::size_t count);

}  // namespace remesh
