//! \file
//! Chooses the creases that a mesh of a spacing can have. Private to remeshing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/curves/curve_sites.h"
#include "remesh/names.h"

namespace remesh {

//! How long edges may be at a point.
struct SizedPoint {
    SurfacePoint at;
    double length = 0;  //!< Mesh units.
    double radius = 0;  //!< Mesh units: so far around it edges have this length.
};

//! How fast lengths grow beside strips, over the distance.
constexpr double strip_slope = 0.5;

//! Creases that run much closer to each other, or to the boundary, than the sites would be: the
//! heavier one stays (length times angle), and the pieces of the other that are too close go. What
//! then dangles goes as well, and so do closed chains of a few spacings. Where curves meet they may
//! be close.
//!
//! Both stay if shorter edges on the strip between them are worth the vertices that they take: what
//! the distance from the surface loses there against what it gains at the creases. Strips of one
//! depth go or stay together.
//! \param spacing    of the sites in the mean, mesh units.
//! \param length_at  how long edges will be at a point, mesh units; empty: all as the spacing. Where
//!                   they are shorter, close is what is close for them.
//! \param num_sites  of these strips may take about a third; 0: lengths are not ours to choose.
//! \param is_fixed   #E: creases that stay in any case; empty: none.
//! \param is_crease  #E; edited in place.
//! \return points along the strips that stay, on both sides of their creases.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(#E + length of the creases / spacing), k log k for k chains; for each of six depths.
std::vector<SizedPoint> select_creases(const Surface& surface, double spacing,
                                       const UnitAt& length_at, double num_sites,
                                       std::span<const std::uint8_t> is_fixed, int num_threads,
                                       const Progress& progress,
                                       std::vector<std::uint8_t>& is_crease);

}  // namespace remesh
