#include "agvd/diagram/diagram.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "agvd/diagram/face_relays.h"
#include "agvd/diagram/stages.h"
#include "agvd/propagation/shape_source.h"

namespace agvd {
namespace {

// All stages but drawing the points.
Diagram build_complex(const StageInput& input, Index num_sites, DiagramParts& parts) {
    parts.num_sites = num_sites;
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

// The points that own their own places, and their sites.
struct OwnPlaces {
    std::vector<SurfacePoint> points;
    std::vector<Index> sites;
    Index num_sites;
};

OwnPlaces own_places(const Surface& surface, std::span<const SurfacePoint> points,
                     const Propagation& propagation) {
    const std::vector<Index>& sites = propagation.site_of_point;
    if (sites.empty() && propagation.shapes.empty()) {
        OwnPlaces all{{points.begin(), points.end()}, std::vector<Index>(points.size()), 0};
        std::iota(all.sites.begin(), all.sites.end(), Index{0});
        all.num_sites = size_of(all.sites);
        return all;
    }
    OwnPlaces own{{}, {}, 0};
    for (const Index site : sites) own.num_sites = std::max(own.num_sites, site + 1);
    for (const SiteShape& shape : propagation.shapes) {
        own.num_sites = std::max(own.num_sites, shape.site + 1);
        for (const Index v : shape_source(surface, shape).vertices) {
            if (propagation.vertex_site[v].value() != shape.site) continue;
            own.points.push_back(point_at(surface, v));
            own.sites.push_back(shape.site);
        }
    }
    for (Index i = 0; i < points.size(); ++i) {
        if (label_at(surface, propagation, points[i]).site.value() != sites[i]) continue;
        own.points.push_back(points[i]);
        own.sites.push_back(sites[i]);
    }
    return own;
}

// \param relays  not null: freed when they have been read for the last time.
Diagram build(const Surface& surface, std::span<const SurfacePoint> sites,
              const Propagation& propagation, const DiagramOptions& options,
              std::vector<Relay>* relays) {
    if (options.chord && !(*options.chord > 0)) {
        throw InvalidOption("the chord is " + std::to_string(*options.chord) +
                            "; use a length above 0");
    }
    if (options.chord && !propagation.shapes.empty()) {
        throw InvalidOption(
            "arcs are made for sites that are points; leave the chord out where sites are lines or "
            "regions");
    }
    Poller poller(options.progress);
    poller.poll();
    const OwnPlaces own = own_places(surface, sites, propagation);
    const SitePlacement placement(surface, own.points, own.sites);
    DiagramParts parts;
    const StageInput input{surface,       own.points,          own.sites,
                           placement,     propagation,         options.chord_tolerance,
                           options.chord, options.num_threads, poller};
    Diagram diagram = build_complex(input, own.num_sites, parts);
    if (options.chord) shape_arcs(input, parts);
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
