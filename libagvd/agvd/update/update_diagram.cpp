// The stages of build_parts.h and absorb_islands.h, each with what a change touches.
#include "agvd/update/update_diagram.h"

#include <utility>

#include "agvd/diagram/build_parts.h"
#include "agvd/diagram/draw.h"
#include "agvd/diagram/site_holders.h"
#include "agvd/update/update_arcs.h"
#include "agvd/update/update_drawing.h"
#include "agvd/update/update_labels.h"

namespace agvd {
namespace {

// Those of sites in touched faces.
void update_displaced(const StageInput& input, const TouchedParts& touched, KeptDiagram& kept) {
    const EdgeLabels& labels = kept.parts.labels;
    const auto num_sites = static_cast<Index>(input.sites.size());
    const CellSet inner = inner_sites(labels, num_sites);
    kept.displaced.resize(num_sites);
    for (Index s = 0; s < num_sites; ++s) {
        if (!touched.is_near(input.sites[s].face.value())) continue;
        kept.displaced.set(s, is_displaced(input, labels, inner, s));
    }
}

// \param restored  the vertices that lost the labels that islands gave them.
void update_nearest(const StageInput& input, const TouchedParts& touched,
                    std::span<const Index> restored, KeptDiagram& kept, Diagram& diagram) {
    const EdgeLabels& labels = kept.parts.labels;
    if (std::exchange(kept.is_renumbered, false)) {
        draw_nearest(input.surface, labels, diagram);
        return;
    }
    const auto take_site = [&](Index v) { diagram.nearest_site[v] = SiteId(labels.point_site[v]); };
    for (const Index v : touched.vertices()) {
        diagram.nearest_distance[v] = labels.vertex_distance[v];
        take_site(v);
    }
    for (const Index v : restored) take_site(v);
    for (const OldLabel& old : kept.absorbed.points) take_site(old.point);
}

}  // namespace

KeptDiagram build_kept_diagram(const StageInput& input, Diagram& diagram) {
    DiagramParts parts = build_parts(input);
    CellSet displaced = find_displaced(input, parts.labels);
    AbsorbedIslands absorbed = absorb_islands(input, displaced, CellSet(), parts);
    std::vector<FaceVoronoiVertices> voronoi_vertices =
        list_voronoi_vertices(parts.arcs, input.propagation.mixed_faces);
    KeptDiagram kept{std::move(parts), std::move(displaced), std::move(absorbed),
                     std::move(voronoi_vertices)};
    Diagram whole;
    update_drawing(input.surface, Ticker(input.poller), kept, whole);
    draw_nearest(input.surface, kept.parts.labels, whole);
    diagram = std::move(whole);
    return kept;
}

void update_diagram(const StageInput& input, std::span<const Index> changed_faces,
                    KeptDiagram& kept, Diagram& diagram) {
    DiagramParts& parts = kept.parts;
    std::vector<Index> faces(changed_faces.begin(), changed_faces.end());
    faces.insert(faces.end(), kept.absorbed.faces.begin(), kept.absorbed.faces.end());
    TouchedParts touched(input.surface, faces);
    parts.tally.resize(static_cast<Index>(input.sites.size()));

    const std::vector<Index> restored = restore_labels(input.surface, kept);
    update_vertices(input, touched, parts);
    const std::vector<Index> stale = faces_with_stale_edges(touched, parts.labels);
    update_edges(input, stale, touched, parts);
    std::vector<Index> traced = update_arcs(input, touched, parts);
    update_displaced(input, touched, kept);
    kept.absorbed = absorb_islands(input, kept.displaced, kept.absorbed.in_doubt, parts);

    traced.insert(traced.end(), kept.absorbed.faces.begin(), kept.absorbed.faces.end());
    update_voronoi_vertices(parts.arcs, std::move(traced), kept.voronoi_vertices);
    update_drawing(input.surface, Ticker(), kept, diagram);  // Does not throw.
    update_nearest(input, touched, restored, kept, diagram);
}

}  // namespace agvd
