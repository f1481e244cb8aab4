#include <numeric>
#include <string>

#include "agvd/diagram/diagram.h"
#include "agvd/diagram/stages.h"
#include "agvd/diagram/tracer.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

void check_options(const DiagramOptions& options, std::span<const SiteShape> shapes) {
    if (options.chord && !(*options.chord > 0)) {
        throw InvalidOption("the chord is " + std::to_string(*options.chord) +
                            "; use a length above 0");
    }
    if (options.chord && !shapes.empty()) {
        throw InvalidOption(
            "arcs are made for sites that are points; leave the chord out where sites are lines or "
            "regions");
    }
}

// What the engine says.
EdgeLabels labels_of(const Surface& surface, const Propagation& propagation) {
    EdgeLabels labels;
    labels.mixed_index.assign(surface.num_faces(), no_index);
    for (Index i = 0; i < propagation.mixed_faces.size(); ++i) {
        labels.mixed_index[propagation.mixed_faces[i]] = i;
    }
    labels.vertex_distance = propagation.vertex_distance;
    labels.point_site.reserve(surface.num_vertices());
    for (const SiteId site : propagation.vertex_site) labels.point_site.push_back(site.value());
    labels.edge_rows.assign(surface.num_edges(), {});
    return labels;
}

SitePlaces own_places(const Surface& surface, std::span<const SurfacePoint> points,
                      const Propagation& propagation, const EdgeLabels& labels) {
    SitePlaces all = all_places(surface, points, propagation.site_of_point, propagation.shapes);
    if (all.own_all) return all;
    SitePlaces own;
    own.num_sites = all.num_sites;
    for (Index i = 0; i < all.points.size(); ++i) {
        if (!owns_its_place(surface, propagation, labels, all, i)) continue;
        own.points.push_back(all.points[i]);
        own.sites.push_back(all.sites[i]);
    }
    return own;
}

// By vertex: 0 for those of an unlisted face, which lies in one cell.
std::vector<std::uint8_t> vertices_in_mixed_faces(const Surface& surface,
                                                  const EdgeLabels& labels) {
    std::vector<std::uint8_t> result(surface.num_vertices(), 1);
    for (Index f = 0; f < surface.num_faces(); ++f) {
        if (labels.mixed_index[f] != no_index) continue;
        for (const Index v : surface.mesh.triangles[f]) result[v] = 0;
    }
    return result;
}

// The lower half-edge of each edge all of whose faces are mixed.
std::vector<Index> labelled_edges(const StageInput& in, const EdgeLabels& labels) {
    std::vector<Index> half_edges;
    Ticker ticker(in.poller);
    for (const Index face : in.propagation.mixed_faces) {
        ticker.tick();
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Index twin = in.surface.twin[h];
            if (twin == no_index ||
                (h < twin && labels.mixed_index[Surface::face(twin)] != no_index)) {
                half_edges.push_back(h);
            }
        }
    }
    return half_edges;
}

// The faces in which a cell may lie that meets none of their corners, and those where labels change
// more than three times. Elsewhere the label of the boundary tells what lies inside: its stretches
// are of different sites, so the one with a corner is connected with the site. Finds the crossings
// there that are guessed, and those beside sites on edges.
std::vector<Index> faces_to_cut(const StageInput& in, std::span<const Index> all,
                                EdgeLabels& labels) {
    const bool are_plain = in.propagation.start_of_point.empty() && in.propagation.shapes.empty();
    std::vector<Index> positions, half_edges;
    Ticker ticker(in.poller);
    for (const Index i : all) {
        ticker.tick();
        const Index h = 3 * in.propagation.mixed_faces[i];
        Index num_inside = 0, num_changes = 0;
        bool is_at_corner = false;
        for (const PlacedSite& placed : in.placement.in_face(Surface::face(h))) {
            if (half_edge_of(placed.point)) {
                half_edges.insert(half_edges.end(), {h, h + 1, h + 2});
                continue;
            }
            ++num_inside;
            for (const Index v : in.surface.mesh.triangles[Surface::face(h)]) {
                is_at_corner = is_at_corner || labels.point_site[v] == placed.site;
            }
        }
        if (num_inside == 0) continue;
        for (Index k = 0; k < 3; ++k) num_changes += labels.edge_rows[in.surface.edge[h + k]].count;
        if (are_plain && num_inside == 1 && is_at_corner && num_changes <= 3) continue;
        positions.push_back(i);
        half_edges.insert(half_edges.end(), {h, h + 1, h + 2});
    }
    find_guessed(in, half_edges, labels);
    return positions;
}

// \param relays  not null: freed when they have been read for the last time.
Diagram build(const Surface& surface, std::span<const SurfacePoint> sites,
              const Propagation& propagation, const DiagramOptions& options,
              std::vector<Relay>* relays) {
    check_options(options, propagation.shapes);
    LabelledMesh mesh(surface, sites, propagation, options);
    mesh.poller.tell(0.5);
    trace_faces(mesh.input, mesh.all, mesh.parts);
    mesh.poller.tell(0.9);
    const auto release = [&] {
        if (relays != nullptr) std::vector<Relay>().swap(*relays);
    };
    return *draw(mesh.input, std::move(mesh.parts), release);
}

}  // namespace

LabelledMesh::LabelledMesh(const Surface& surface, std::span<const SurfacePoint> sites,
                           const Propagation& propagation, const DiagramOptions& options,
                           bool may_guess)
    : poller(options.progress),
      parts{.labels = labels_of(surface, propagation)},
      own(own_places(surface, sites, propagation, parts.labels)),
      placement(surface, own.points, own.sites),
      input{surface,       own.points,          own.sites,
            placement,     propagation,         options.chord_tolerance,
            options.chord, options.num_threads, poller},
      all(propagation.mixed_faces.size()) {
    poller.poll();
    parts.num_sites = own.num_sites;
    parts.labels.first_crossing_node = surface.num_vertices() + size_of(own.points);
    std::iota(all.begin(), all.end(), Index{0});
    label_vertices(input, all, vertices_in_mixed_faces(surface, parts.labels), parts.labels);
    label_edges(input, labelled_edges(input, parts.labels), parts.labels, may_guess);
    cut_faces(input, may_guess ? faces_to_cut(input, all, parts.labels) : all, parts.labels);
    parts.arcs.faces.resize(all.size());
}

std::optional<Diagram> draw(const StageInput& input, DiagramParts parts,
                            const std::function<void()>& release) {
    const Surface& surface = input.surface;
    parts.boundary_loops = boundary_loops(surface);
    parts.joined = join_arcs(parts.labels, parts.arcs, Ticker(input.poller));
    std::optional<Diagram> diagram = absorb_islands(input, parts);
    if (!diagram) return {};
    if (input.chord) shape_arcs(input, parts);
    release();
    measure_cells(surface, parts, Ticker(input.poller), *diagram);
    // What only these stages read is freed: with the points it would be a third of the memory.
    std::vector<CellPart>().swap(parts.arcs.parts);
    std::vector<Connection>().swap(parts.arcs.connections);
    std::vector<FaceArcs>().swap(parts.arcs.faces);
    std::vector<Index>().swap(parts.joined.edge_of_arc);
    std::vector<Index>().swap(parts.labels.mixed_index);
    if (parts.boundary_loops.empty()) std::vector<Block>().swap(parts.labels.edge_rows);
    draw_points(surface, parts, Ticker(input.poller), *diagram);
    diagram->nearest_site.reserve(surface.num_vertices());
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        diagram->nearest_site.push_back(SiteId(parts.labels.point_site[v]));
    }
    diagram->nearest_distance = std::move(parts.labels.vertex_distance);
    input.poller.tell(1);
    return diagram;
}

Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                      const Propagation& propagation, const DiagramOptions& options) {
    return build(surface, sites, propagation, options, nullptr);
}

Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                      Propagation&& propagation, const DiagramOptions& options) {
    return build(surface, sites, propagation, options, &propagation.relays);
}

TracedDiagram trace_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                            const PropagationOptions& propagating, const DiagramOptions& options) {
    check_options(options, propagating.shapes);
    if (propagating.engine == Engine::Steiner && !propagating.max_error) {
        auto traced = trace_behind_front(surface, sites, propagating, options);
        if (traced) return std::move(*traced);
    }
    Propagation propagation = propagate(surface, sites, propagating);
    const double certified_error = propagation.certified_error;
    const std::size_t num_relays = propagation.relays.size();
    return {build_diagram(surface, sites, std::move(propagation), options), certified_error,
            num_relays};
}

}  // namespace agvd
