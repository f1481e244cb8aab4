//! \file
//! The paper's engine: multi-source propagation over Steiner points.
#pragma once

#include "agvd/propagation/propagation_options.h"
#include "agvd/propagation/relays.h"

namespace agvd {

//! propagate() with checked options.
[[nodiscard]] Propagation propagate_steiner(const Surface& surface,
                                            std::span<const SurfacePoint> sites,
                                            const PropagationOptions& options);

}  // namespace agvd
