#include "agvd/diagram/build_diagram.h"

#include "agvd/diagram/diagram_builder.h"

namespace agvd {

Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                      const Propagation& propagation, const DiagramOptions& options) {
    Diagram diagram;
    DiagramBuilder(surface, options).build(sites, propagation, {}, diagram);
    poll(options.progress, 1);
    return diagram;
}

}  // namespace agvd
