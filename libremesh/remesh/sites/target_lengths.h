//! \file
//! Target lengths from curvature, lengths or densities: bounded, gradual, and scaled to a number of
//! vertices.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "remesh/sites/sizing.h"

namespace remesh {

//! The edge of an equilateral triangle whose corners lie on a sphere of this curvature and whose
//! middle is off by `error`: sqrt(6 e / k - 3 e^2) (pmp and CGAL have it too). Where the radius is
//! below the error, that of the radius e: e sqrt(3).
//!
//! \param curvature  >= 0; 0 gives infinity.
//! \param error      > 0.
[[nodiscard]] double length_for_error(double curvature, double error);

struct TargetLengths {
    std::vector<double> length;  //!< #V; mesh units.
};

//! \param values  #V: curvatures (patch_curvature), lengths or densities, whichever `sizing` asks
//!        for.
//! \param most    #V: no target is longer; or empty.
//! \param least   #V: edges that stay are so long there; 0: none. Targets fall from there by at most
//!        half the distance, except below `most`. Or empty.
//! \param joined  see limit_growth.
//! \param area    in squares of the local length, that the result has; 0: as the lengths give it.
//!        Bounds and gradation hold in the scaled lengths unless no scale gives this area: then all
//!        are multiplied by one factor in the end.
//! Cost: O(n log n) for each scale that is tried, some five.
[[nodiscard]] TargetLengths target_lengths(const Surface& surface, std::span<const double> values,
                                           std::span<const double> most,
                                           std::span<const std::pair<Index, Index>> joined,
                                           const Sizing& sizing, double area, Ticker& ticker,
                                           std::span<const double> least = {});

}  // namespace remesh
