#include "agvd/diagram/build_diagram.h"

#include "agvd/diagram/absorb_islands.h"
#include "agvd/diagram/build_parts.h"
#include "agvd/diagram/draw.h"
#include "agvd/diagram/site_holders.h"

namespace agvd {

namespace {

// \param free_relays  called when the relays have been read for the last time.
template <typename FreeRelays>
Diagram build(const Surface& surface, std::span<const SurfacePoint> sites,
              const Propagation& propagation, const DiagramOptions& options,
              const FreeRelays& free_relays) {
    Poller poller(options.progress);
    poller.poll();
    const SitePlacement placement(surface, sites);
    const StageInput input{
        surface, sites, placement, propagation, options.chord_tolerance, options.num_threads,
        poller};
    DiagramParts parts = build_parts(input);
    absorb_islands(input, find_displaced(input, parts.labels), CellSet(), parts);
    free_relays();
    Diagram diagram = draw_diagram(surface, parts, propagation.mixed_faces, Ticker(poller));
    poll(options.progress, 1);
    return diagram;
}

}  // namespace

Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                      const Propagation& propagation, const DiagramOptions& options) {
    return build(surface, sites, propagation, options, [] {});
}

Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                      Propagation&& propagation, const DiagramOptions& options) {
    return build(surface, sites, propagation, options,
                 [&] { std::vector<Relay>().swap(propagation.relays); });
}

}  // namespace agvd
