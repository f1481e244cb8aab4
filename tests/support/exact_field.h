//! \file
//! Exact distances with relays in all faces, as paths and isolines need them.
#pragma once

#include <span>

#include "agvd/propagation/propagate.h"

namespace support {

[[nodiscard]] inline agvd::Propagation exact_everywhere(const agvd::Surface& surface,
                                                        std::span<const agvd::SurfacePoint> sites) {
    return propagate(surface, sites, {.max_error = 0, .relay_faces = agvd::all_faces(surface)});
}

}  // namespace support
