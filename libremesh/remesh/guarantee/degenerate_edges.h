//! \file
//! Voronoi edges of no length: where more than three cells meet in one point.
#pragma once

#include "agvd/core/poller.h"
#include "agvd/diagram/diagram.h"

namespace remesh {

//! #edges: true for an edge between two inner Voronoi vertices at one place (up to rounding). The
//! dual is free to choose another diagonal there.
[[nodiscard]] std::vector<bool> find_degenerate_edges(const agvd::Surface& surface,
                                                      const agvd::Diagram& diagram,
                                                      agvd::Ticker ticker = {});

}  // namespace remesh
