// For a build without the engine of Steiner points: its callers propagate, which names the remedy.
#include "agvd/diagram/tracer.h"

namespace agvd {

std::optional<TracedDiagram> trace_behind_front(const Surface&, std::span<const SurfacePoint>,
                                                const PropagationOptions&, const DiagramOptions&) {
    return {};
}

}  // namespace agvd
