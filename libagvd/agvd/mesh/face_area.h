//! \file
//! Area of a face.
#pragma once

#include "agvd/mesh/surface.h"

namespace agvd {

//! Square mesh units.
[[nodiscard]] inline double face_area(const Surface& surface, Index face) {
    const std::size_t h = std::size_t{3} * face;
    return surface.length[surface.edge[h]] * surface.apex[h].y() / 2;
}

}  // namespace agvd
