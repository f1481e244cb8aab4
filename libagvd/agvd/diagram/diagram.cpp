#include "agvd/diagram/diagram.h"

#include <algorithm>

#include "agvd/core/parallel.h"
#include "agvd/diagram/cuts.h"
#include "agvd/diagram/edge_relays.h"
#include "agvd/diagram/islands.h"
#include "agvd/diagram/join.h"

namespace agvd {
namespace {

// Small, since a chunk is traced again as a whole where an island was absorbed.
constexpr Index grain = 128;

double face_area(const Surface& surface, Index face) {
    return surface.length_of(3 * face) * surface.apex[3 * face].y() / 2;
}

// Areas and Euler characteristics: the open cell is a union of open pieces of triangles, open
// intervals of inner edges and cuts, and inner points, and for a surface without its boundary their
// alternating sum is the Euler characteristic.
void measure_cells(const Surface& surface, const EdgeLabels& labels,
                   std::span<const FaceArcs> chunks, Diagram& diagram) {
    diagram.cell_area.assign(diagram.num_sites, 0);
    diagram.cell_euler.assign(diagram.num_sites, 0);
    const auto count = [&](Index site, int change) {
        if (site != no_index) diagram.cell_euler[site] += change;
    };
    for (Index f = 0; f < surface.num_faces(); ++f) {
        if (labels.mixed_index[f] != no_index) continue;
        const Index site = labels.point_site[surface.mesh.triangles[f][0]];
        count(site, 1);
        if (site != no_index) diagram.cell_area[site] += face_area(surface, f);
    }
    for (const FaceArcs& chunk : chunks) {
        for (const FaceArcs::CellPart& part : chunk.parts) {
            count(part.site, part.pieces);
            diagram.cell_area[part.site] += part.area;
        }
    }
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        if (surface.twin[h] == no_index) continue;
        count(labels.point_site[surface.tail(h)], -1);
        for (const Crossing& c : labels.on_edge(e)) count(c.site_after, -1);
    }
    for (const Cut& cut : labels.cuts) {
        count(labels.point_site[cut.from], -1);
        for (const Crossing& c : labels.in_row(cut.row)) count(c.site_after, -1);
    }
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        if (surface.outgoing[v] == no_index || surface.is_boundary_vertex(v)) continue;
        count(labels.point_site[v], 1);
    }
    for (const InnerPoint& point : labels.inner_points) count(point.site, 1);
}

}  // namespace

Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                      const Propagation& propagation, const DiagramOptions& options) {
    poll(options.progress, 0);
    const SitePlacement placement(surface, sites);
    const auto stored = find_reaches(surface, propagation, options.num_threads);
    const std::span<const RelayReach> reaches(stored.get(), propagation.relays.size());
    EdgeLabels labels = label_edges(surface, propagation, reaches, options.num_threads);
    cut_faces(surface, propagation, placement, reaches, labels);
    const std::vector<Index> joined_points = join_points(surface, labels);
    poll(options.progress, 0.5);

    const auto num_mixed = static_cast<Index>(propagation.mixed_faces.size());
    std::vector<FaceArcs> chunks(num_chunks(num_mixed, grain));
    std::vector<std::uint8_t> is_stale(num_mixed, 1);
    do {
        parallel_chunks(
            num_mixed, grain, options.num_threads, [&](Index chunk, Index begin, Index end) {
                const auto first = is_stale.begin() + begin;
                if (std::find(first, is_stale.begin() + end, 1) == is_stale.begin() + end) return;
                trace_faces(surface, propagation, reaches, labels, options.chord_tolerance, begin,
                            end, chunks[chunk]);
            });
        is_stale.assign(num_mixed, 0);
    } while (absorb_islands(surface, sites, chunks, joined_points, labels, is_stale) > 0);
    poll(options.progress, 0.9);

    Diagram diagram;
    diagram.num_sites = static_cast<Index>(sites.size());
    join_arcs(surface, labels, chunks, diagram);
    measure_cells(surface, labels, chunks, diagram);
    diagram.nearest_site.reserve(surface.num_vertices());
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        diagram.nearest_site.push_back(SiteId(labels.point_site[v]));
    }
    diagram.nearest_distance = std::move(labels.vertex_distance);
    poll(options.progress, 1);
    return diagram;
}

}  // namespace agvd
