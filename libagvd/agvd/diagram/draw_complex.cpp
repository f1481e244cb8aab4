// Numbers the edges, then attaches their ends to the vertices: first at Voronoi vertices, then
// along the surface's boundary, where an edge between cells meets two edges of the boundary. Each
// vertex gets its ends counter-clockwise, and the cell after each end.
#include "agvd/diagram/draw_complex.h"

#include <cassert>

namespace agvd {
namespace {

void attach(const EdgeEnd& end, Index site, Index vertex, Diagram& out) {
    out.vertex_ends.push_back(end);
    out.vertex_sites.push_back(SiteId(site));
    (end.is_tail ? out.edges[end.edge].tail : out.edges[end.edge].head) = vertex;
}

void finish_vertex(Diagram& out) {
    out.vertex_offsets.push_back(static_cast<Index>(out.vertex_ends.size()));
}

// The end of the Voronoi edge that lies at the end of an arc.
// \param numbers  by name of the edge, in the diagram.
EdgeEnd edge_end(const JoinedEdges& joined, std::span<const Index> numbers, ArcEnd end) {
    const Index name = joined.edge_of_arc[end.arc()];
    assert(joined.first_ends[name] == end || joined.edges[name].last == end);
    return {numbers[name], joined.first_ends[name] == end};
}

// \return their numbers, by name.
std::vector<Index> list_edges(const JoinedEdges& joined, Ticker& ticker, Diagram& out) {
    std::vector<Index> numbers(joined.edges.size());
    out.edges.clear();
    for (const Index name : joined.order) {
        ticker.tick();
        numbers[name] = static_cast<Index>(out.edges.size());
        const JoinedEdges::Edge& edge = joined.edges[name];
        out.edges.push_back({SiteId(edge.left), SiteId(edge.right), no_index, no_index});
    }
    return numbers;
}

void add_voronoi_vertices(const DrawingInput& in, std::span<const Index> numbers, Ticker& ticker,
                          Diagram& out) {
    Index vertex = 0;
    for (const FaceVoronoiVertices& in_face : in.voronoi_vertices) {
        ticker.tick();
        for (const ArcStore::VoronoiVertex& voronoi_vertex :
             in.parts.arcs.voronoi_vertices()[in_face.voronoi_vertices]) {
            for (std::size_t k = 0; k < 3; ++k) {
                attach(edge_end(in.parts.joined, numbers, voronoi_vertex.ends[k]),
                       voronoi_vertex.sites[k], vertex, out);
            }
            finish_vertex(out);
            ++vertex;
        }
    }
}

// The arcs of one loop of the boundary between its label changes, and the vertices at these.
void add_boundary_arcs(const DrawingInput& in, std::span<const BoundaryCrossing> crossings,
                       std::span<const Index> numbers, Diagram& out) {
    const auto first_edge = static_cast<Index>(out.edges.size());
    const auto count = static_cast<Index>(crossings.size());
    for (const BoundaryCrossing& from : crossings) {
        out.edges.push_back({SiteId(from.site_after), {}, no_index, no_index});
    }
    for (Index i = 0; i < count; ++i) {
        const BoundaryCrossing& c = crossings[i];
        const auto vertex = static_cast<Index>(out.vertex_offsets.size()) - 1;
        const Index behind = first_edge + (i + count - 1) % count;
        const ArcEnd inwards = in.parts.joined.crossing_ends[c.crossing][0];
        attach({first_edge + i, true}, c.site_after, vertex, out);
        attach(edge_end(in.parts.joined, numbers, inwards), c.site_before, vertex, out);
        attach({behind, false}, no_index, vertex, out);
        finish_vertex(out);
    }
}

void add_boundary(const DrawingInput& in, std::span<const Index> numbers, Diagram& out) {
    for (std::size_t i = 0; i < in.boundary.size(); ++i) {
        const Index site =
            in.parts.labels.point_site[in.surface.tail(in.parts.boundary_loops[i][0])];
        if (!in.boundary[i].empty()) {
            add_boundary_arcs(in, in.boundary[i], numbers, out);
        } else if (site != no_index) {
            out.edges.push_back({SiteId(site), {}, no_index, no_index});
        }
    }
}

}  // namespace

std::vector<FaceVoronoiVertices> list_voronoi_vertices(const ArcStore& arcs,
                                                       std::span<const Index> faces) {
    std::vector<FaceVoronoiVertices> list;
    for (const Index face : faces) {
        const Block& voronoi_vertices = arcs.of_face(face).voronoi_vertices;
        if (voronoi_vertices.count > 0) list.push_back({face, voronoi_vertices});
    }
    return list;
}

DrawingInput drawing_input(const Surface& surface, const DiagramParts& parts,
                           std::span<const FaceVoronoiVertices> voronoi_vertices) {
    DrawingInput input{surface, parts, voronoi_vertices, {}};
    for (const std::vector<Index>& loop : parts.boundary_loops) {
        std::vector<BoundaryCrossing>& crossings = input.boundary.emplace_back();
        for (Index i = 0; i < loop.size(); ++i) {
            // A boundary edge has one half-edge, so its crossings run along the loop.
            const Block& row = parts.labels.edge_rows[surface.edge[loop[i]]];
            for (Index crossing = row.begin; crossing < row.end(); ++crossing) {
                const Crossing& c = parts.labels.crossings[crossing];
                crossings.push_back({crossing, i, c.site_before, c.site_after});
            }
        }
    }
    return input;
}

void draw_complex(const DrawingInput& input, Ticker ticker, Diagram& diagram) {
    const std::vector<Index> numbers = list_edges(input.parts.joined, ticker, diagram);
    diagram.vertex_offsets.assign(1, 0);
    diagram.vertex_ends.clear();
    diagram.vertex_sites.clear();
    add_voronoi_vertices(input, numbers, ticker, diagram);
    add_boundary(input, numbers, diagram);
}

}  // namespace agvd
