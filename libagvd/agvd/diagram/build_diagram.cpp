#include "agvd/diagram/diagram.h"

#include <numeric>
#include <string>

#include "agvd/diagram/stages.h"

namespace agvd {
namespace {

// All stages but drawing the points.
Diagram build_complex(const StageInput& input, DiagramParts& parts) {
    parts.num_sites = static_cast<Index>(input.sites.size());
    parts.boundary_loops = boundary_loops(input.surface);
    label_vertices(input, parts.labels);
    label_edges(input, parts.labels);
    cut_faces(input, parts.labels);
    input.poller.tell(0.5);
    std::vector<Index> all(input.propagation.mixed_faces.size());
    std::iota(all.begin(), all.end(), Index{0});
    parts.arcs.faces.resize(all.size());
    trace_faces(input, all, parts);
    input.poller.tell(0.9);
    parts.joined = join_arcs(parts.labels, parts.arcs, Ticker(input.poller));
    return absorb_islands(input, parts);
}

// \param relays  not null: freed when they have been read for the last time.
Diagram build(const Surface& surface, std::span<const SurfacePoint> sites,
              const Propagation& propagation, const DiagramOptions& options,
              std::vector<Relay>* relays) {
    if (!(options.tolerance > 0)) {
        throw InvalidOption("the tolerance of arcs is " + std::to_string(options.tolerance) +
                            "; use a number above 0");
    }
    Poller poller(options.progress);
    poller.poll();
    const SitePlacement placement(surface, sites);
    DiagramParts parts;
    Diagram diagram =
        build_complex({surface, sites, placement, propagation, options, poller}, parts);
    if (relays != nullptr) std::vector<Relay>().swap(*relays);
    draw_points(surface, parts, Ticker(poller), diagram);
    measure_cells(surface, parts, Ticker(poller), diagram);
    diagram.nearest_site.reserve(surface.num_vertices());
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        diagram.nearest_site.push_back(SiteId(parts.labels.point_site[v]));
    }
    diagram.nearest_distance = std::move(parts.labels.vertex_distance);
    poll(options.progress, 1);
    return diagram;
}

}  // namespace

Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                      const Propagation& propagation, const DiagramOptions& options) {
    return build(surface, sites, propagation, options, nullptr);
}

Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                      Propagation&& propagation, const DiagramOptions& options) {
    return build(surface, sites, propagation, options, &propagation.relays);
}

}  // namespace agvd
