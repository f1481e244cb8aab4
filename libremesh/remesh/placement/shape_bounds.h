//! \file
//! Bounds that every triangle of a result is to keep.
#pragma once

#include <algorithm>

#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh {

//! What no triangle is to exceed. Each is a promise: where it cannot be kept there is no result.
//! Angles that the input forces are told: see RemeshResult::forced.
struct ShapeBounds {
    double min_angle = 0;            //!< Degrees, 0 to 30: no angle is smaller.
    double max_angle = 180;          //!< Degrees, 90 to 180: no angle is larger.
    double longest_edge = infinity;  //!< > 0, mesh units: no edge is longer.

    [[nodiscard]] bool has_angles() const { return min_angle > 0 || max_angle < 180; }
    [[nodiscard]] bool has_any() const { return has_angles() || longest_edge < infinity; }
};

}  // namespace remesh
