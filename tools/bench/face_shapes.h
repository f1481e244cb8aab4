//! \file
//! The paper's measures of face quality.
#pragma once

#include "agvd/mesh/surface.h"

namespace bench {

struct FaceShapes {
    double mean_lo = 0;   //!< Mean of 4 sqrt(3) S / (a^2 + b^2 + c^2): 1 where all are equilateral.
    double mean_tau = 0;  //!< Mean of P H / (2 sqrt(3) S), P half the perimeter, H the longest
                          //!< edge: 1 where all are equilateral, large for slivers.
    double max_tau = 0;
};

[[nodiscard]] FaceShapes face_shapes(const agvd::Surface& surface);

}  // namespace bench
