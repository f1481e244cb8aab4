// For a build without the engine of Steiner points.
#include "agvd/core/error.h"
#include "agvd/propagation/engines.h"

namespace agvd {

Propagation propagate_steiner(const Surface&, std::span<const SurfacePoint>,
                              const PropagationOptions&) {
    throw InvalidOption(
        "this build is without the Steiner engine; use the window engine, or build with "
        "AGVD_WITH_STEINER=ON");
}

}  // namespace agvd
