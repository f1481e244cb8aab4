//! \file
//! The sites on the borders of tiles. Private to remeshing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "remesh/curves/curve_network.h"

namespace remesh {

//! A point of a border that becomes a vertex of the tiles on both sides.
struct BorderSite {
    Index edge;    //!< Of the surface.
    double share;  //!< In [0, 1]: from the tail of its `edge_half`. 0 and 1: at the vertex there.
    Index number;  //!< Of the site: sites at vertices are listed for each edge of the border there.
};

struct BorderSites {
    std::vector<BorderSite> sites;  //!< By edge, then along it.
    Index num_sites = 0;
};

//! Sites at the ends of the curves along borders, and at some positions between them.
//! \param is_border  #E: all edges of a curve have one value.
//! \param along      #curves: positions between the ends, mesh units; see even_positions().
//! \param spacing    mesh units: sites much nearer to a vertex lie at it.
//! Cost: O(#E + n log n), n = sites.
[[nodiscard]] BorderSites border_sites(const Surface& surface,
                                       std::span<const std::uint8_t> is_border,
                                       const CurveNetwork& network,
                                       std::span<const std::vector<double>> along, double spacing);

}  // namespace remesh
