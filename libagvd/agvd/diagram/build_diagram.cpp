#include "agvd/diagram/build_diagram.h"

#include "agvd/diagram/absorb_islands.h"
#include "agvd/diagram/build_parts.h"
#include "agvd/diagram/draw.h"
#include "agvd/diagram/site_holders.h"

namespace agvd {

Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                      const Propagation& propagation, const DiagramOptions& options) {
    Poller poller(options.progress);
    poller.poll();
    const SitePlacement placement(surface, sites);
    const StageInput input{
        surface, sites, placement, propagation, options.chord_tolerance, options.num_threads,
        poller};
    DiagramParts parts = build_parts(input);
    absorb_islands(input, find_displaced(input, parts.labels), CellSet(), parts);
    Diagram diagram = draw_diagram(surface, parts, propagation.mixed_faces, Ticker(poller));
    poll(options.progress, 1);
    return diagram;
}

}  // namespace agvd
