// For a build without the engine of Steiner points.
#include "agvd/core/error.h"
#include "agvd/propagation/engines.h"

namespace agvd {
namespace {

[[noreturn]] void refuse_engine() {
    throw InvalidOption(
        "this build is without the Steiner engine; use the window engine, or build with "
        "AGVD_WITH_STEINER=ON");
}

}  // namespace

Propagation propagate_steiner(const Surface&, std::span<const SurfacePoint>,
                              const PropagationOptions&) {
    refuse_engine();
}

void retire_steiner(const Surface&, std::span<const SurfacePoint>, const PropagationOptions&,
                    const RetirementSink&) {
    refuse_engine();
}

}  // namespace agvd
