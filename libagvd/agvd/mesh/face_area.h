//! \file
//! Areas of faces.
#pragma once

#include "agvd/mesh/surface.h"

namespace agvd {

//! In square mesh units.
[[nodiscard]] inline double face_area(const Surface& surface, Index face) {
    const Index h = 3 * face;
    return surface.length_of(h) * surface.apex_of(h).y() / 2;
}

//! The area of all faces, summed in their order. Cost: O(#F).
[[nodiscard]] inline double surface_area(const Surface& surface) {
    double area = 0;
    for (Index f = 0; f < surface.num_faces(); ++f) area += face_area(surface, f);
    return area;
}

}  // namespace agvd
