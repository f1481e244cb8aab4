//! \file
//! Voronoi edges without length: where more than three cells meet in one point.
#pragma once

#include "agvd/core/progress.h"
#include "agvd/diagram/diagram.h"
#include "remesh/names.h"

namespace remesh {

//! #edges: true for an edge between two inner Voronoi vertices that coincide up to rounding. There
//! the dual may use either diagonal.
[[nodiscard]] std::vector<bool> find_degenerate_edges(const Surface& surface,
                                                      const Diagram& diagram, Ticker ticker = {});

}  // namespace remesh
