#include "agvd/diagram/loops.h"

#include <cassert>
#include <unordered_map>
#include <utility>

namespace agvd {
namespace {

// An edge as seen from the cell on one side of it, which has the cell on its left.
struct Side {
    Index edge;     // Name.
    bool is_right;  // The right cell's: walked from head to tail.
};

// By crossing: the next label change along the surface's boundary.
using NextOnBoundary = std::unordered_map<Index, Index>;

// A boundary without label changes is a loop of its own.
NextOnBoundary follow_boundary(const Surface& surface, const DiagramParts& parts,
                               const CellSet& cells, std::vector<Index>& count) {
    NextOnBoundary next;
    for (const std::vector<Index>& loop : parts.boundary_loops) {
        Index first = no_index, last = no_index;
        for (const Index h : loop) {
            const Block& row = parts.labels.edge_rows[surface.edge[h]];
            for (Index crossing = row.begin; crossing < row.end(); ++crossing) {
                if (first == no_index) {
                    first = crossing;
                } else {
                    next[last] = crossing;
                }
                last = crossing;
            }
        }
        const Index site = parts.labels.point_site[surface.tail(loop[0])];
        if (first != no_index) {
            next[last] = first;
        } else if (cells.has(site)) {
            ++count[site];
        }
    }
    return next;
}

ArcEnd end_before(const ArcStore::VoronoiVertex& vertex, ArcEnd end) {
    return end == vertex.ends[0]   ? vertex.ends[2]
           : end == vertex.ends[1] ? vertex.ends[0]
                                   : vertex.ends[1];
}

// Around a Voronoi vertex, a cell arrives along an end and leaves along the one before; at a label
// change on the boundary it goes on along the boundary to the next one.
Side next_side(const DiagramParts& parts, const NextOnBoundary& next_on_boundary,
               const Side& side) {
    const JoinedEdges& joined = parts.joined;
    const JoinedEdges::Edge& edge = joined.edges[side.edge];
    if (edge.is_closed()) return side;
    const ArcEnd arriving = side.is_right ? joined.first_ends[side.edge] : edge.last;
    const NodeId node = node_at(parts.arcs, arriving);
    const ArcEnd leaving =
        node.is_voronoi_vertex()
            ? end_before(parts.arcs.voronoi_vertices()[node.voronoi_vertex()], arriving)
            : joined.crossing_ends[next_on_boundary.at(node.crossing())][0];
    const Index next = joined.edge_of_arc[leaving.arc()];
    assert(joined.first_ends[next] == leaving || joined.edges[next].last == leaving);
    return {next, joined.first_ends[next] != leaving};
}

}  // namespace

std::vector<Index> count_loops(const Surface& surface, const DiagramParts& parts,
                               const CellSet& cells) {
    std::vector<Index> count(cells.num_sites(), 0);
    const NextOnBoundary next_on_boundary = follow_boundary(surface, parts, cells, count);
    const JoinedEdges& joined = parts.joined;
    std::vector<std::array<std::uint8_t, 2>> is_seen(joined.edges.size(), {0, 0});
    for (const Index name : joined.order) {
        for (const bool is_right : {false, true}) {
            const JoinedEdges::Edge& edge = joined.edges[name];
            const Index site = is_right ? edge.right : edge.left;
            if (!cells.has(site) || is_seen[name][is_right ? 1 : 0] != 0) continue;
            ++count[site];
            Side side{name, is_right};
            while (std::exchange(is_seen[side.edge][side.is_right ? 1 : 0], 1) == 0) {
                side = next_side(parts, next_on_boundary, side);
            }
        }
    }
    return count;
}

std::vector<Index> faces_on_borders(const DiagramParts& parts, const CellSet& cells) {
    std::vector<Index> faces;
    for (const Index name : parts.joined.order) {
        const JoinedEdges::Edge& edge = parts.joined.edges[name];
        if (cells.has(edge.left) || cells.has(edge.right)) {
            faces.push_back(parts.arcs.arcs()[parts.joined.first_ends[name].arc()].face);
        }
    }
    return faces;
}

}  // namespace agvd
