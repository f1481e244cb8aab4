#include "agvd/diagram/draw.h"

#include "agvd/diagram/draw_points.h"

namespace agvd {

Diagram draw_diagram(const Surface& surface, const DiagramParts& parts,
                     std::span<const Index> faces, Ticker ticker) {
    const std::vector<FaceVoronoiVertices> voronoi_vertices =
        list_voronoi_vertices(parts.arcs, faces);
    const DrawingInput input = drawing_input(surface, parts, voronoi_vertices);
    Diagram diagram;
    draw_complex(input, ticker, diagram);
    clear_points(input, diagram);
    for (const Index name : parts.joined.order) draw_edge(input, name, ticker, diagram);
    draw_boundary(input, diagram);
    draw_vertices(input, diagram);
    parts.tally.write(diagram);
    diagram.num_sites = static_cast<Index>(diagram.cell_area.size());
    draw_nearest(surface, parts.labels, diagram);
    return diagram;
}

void draw_nearest(const Surface& surface, const EdgeLabels& labels, Diagram& diagram) {
    diagram.nearest_distance = labels.vertex_distance;
    diagram.nearest_site.clear();
    diagram.nearest_site.reserve(surface.num_vertices());
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        diagram.nearest_site.push_back(SiteId(labels.point_site[v]));
    }
}

}  // namespace agvd
