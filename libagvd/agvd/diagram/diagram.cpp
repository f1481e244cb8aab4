#include "agvd/diagram/diagram.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "agvd/diagram/stages.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

// The first face that holds both, for a diagram without passages.
CurvePiece piece_in_common_face(const Surface& surface, const SurfacePoint& from,
                                const SurfacePoint& to) {
    const Index face = common_faces(surface, from, to).first;
    if (face == no_index) return {from, from};
    return {*seen_from(surface, from, face), *seen_from(surface, to, face)};
}

Index half_edge_at(const SurfacePoint& point, const Passage& passage) {
    return 3 * point.face.value() + passage.side;
}

// Side of an edge: 2 * edge + (0: left cell, walked tail to head; 1: right cell, head to tail).
using Side = Index;

SiteId site_of(const Diagram& diagram, Side side) {
    const VoronoiEdge& edge = diagram.edges[side / 2];
    return side % 2 == 0 ? edge.left : edge.right;
}

// The side that follows on the same cell's loop. Where an edge arrives at a vertex, its cell lies
// clockwise before it; the loop goes on along the end that this cell follows.
std::vector<Side> next_sides(const Diagram& diagram) {
    std::vector<Side> next(2 * diagram.edges.size());
    std::iota(next.begin(), next.end(), Side{0});  // Closed curves.
    for (Index v = 0; v + 1 < diagram.vertex_offsets.size(); ++v) {
        const Index begin = diagram.vertex_offsets[v];
        const Index valence = diagram.vertex_offsets[v + 1] - begin;
        for (Index i = 0; i < valence; ++i) {
            // The cell between end i and end i + 1 leaves along end i and arrives along end i + 1.
            const EdgeEnd& out = diagram.vertex_ends[begin + i];
            const EdgeEnd& in = diagram.vertex_ends[begin + (i + 1) % valence];
            next[2 * in.edge + (in.is_tail ? 1 : 0)] = 2 * out.edge + (out.is_tail ? 0 : 1);
        }
    }
    return next;
}

// From the number of elements of each site, at site + 1, to offsets.
void add_up(std::vector<Index>& counts) {
    std::partial_sum(counts.begin(), counts.end(), counts.begin());
}

void collect_neighbours(const Diagram& diagram, Ticker& ticker, Cells& cells) {
    std::vector<std::pair<SiteId, SiteId>> pairs;
    for (const VoronoiEdge& edge : diagram.edges) {
        if (!edge.right.is_valid()) continue;
        pairs.emplace_back(edge.left, edge.right);
        pairs.emplace_back(edge.right, edge.left);
    }
    sort_ticked(pairs, ticker, std::less<>());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    cells.neighbour_offsets.assign(diagram.num_sites + 1, 0);
    for (const auto& [site, neighbour] : pairs) {
        ++cells.neighbour_offsets[site.value() + 1];
        cells.neighbours.push_back(neighbour);
    }
    add_up(cells.neighbour_offsets);
}

}  // namespace

CurvePiece curve_piece(const Surface& surface, const Diagram& diagram, Index edge, Index point) {
    const bool is_last = point + 1 == diagram.edge_points[edge + 1];
    const Index next = is_last ? diagram.edge_points[edge] : point + 1;
    CurvePiece piece{diagram.points[point], diagram.points[next]};
    if (diagram.passages.empty()) return piece_in_common_face(surface, piece.from, piece.to);
    const Passage& out = diagram.passages[point];
    const Passage& in = diagram.passages[next];
    if (!diagram.edges[edge].right.is_valid()) {
        if (in.leaves) {  // The mesh vertex at the head.
            piece.to = point_on(Surface::next(half_edge_at(piece.from, out)), 0);
        }
        return piece;
    }
    if (out.side != Passage::none && out.leaves) {
        piece.from = across_edge(surface, piece.from, half_edge_at(piece.from, out));
    }
    if (in.side != Passage::none && !in.leaves) {
        piece.to = across_edge(surface, piece.to, half_edge_at(piece.to, in));
    }
    return piece;
}

double curve_length(const Surface& surface, const Diagram& diagram, Index edge) {
    double sum = 0;
    for (Index i = diagram.edge_points[edge]; i + 1 < diagram.edge_points[edge + 1]; ++i) {
        const auto [from, to] = curve_piece(surface, diagram, edge, i);
        sum += face_distance(surface, from, to);
    }
    return sum;
}

void collect_loops(const Diagram& diagram, Ticker& ticker, Cells& cells) {
    struct Loop {
        SiteId site;
        Index begin, end;  // Of `walked`.
    };
    const std::vector<Side> next = next_sides(diagram);
    std::vector<DirectedEdge> walked;
    std::vector<Loop> loops;
    std::vector<bool> seen(next.size(), false);
    for (Side start = 0; start < next.size(); ++start) {
        if (seen[start] || !site_of(diagram, start).is_valid()) continue;
        const auto begin = size_of(walked);
        for (Side side = start; !seen[side]; side = next[side]) {
            ticker.tick();
            seen[side] = true;
            walked.push_back({side / 2, side % 2 == 1});
        }
        loops.push_back({site_of(diagram, start), begin, size_of(walked)});
    }
    std::stable_sort(loops.begin(), loops.end(),
                     [](const Loop& a, const Loop& b) { return a.site < b.site; });
    cells.cell_loops.assign(diagram.num_sites + 1, 0);
    cells.loop_edges.assign(1, 0);
    for (const auto& [site, begin, end] : loops) {
        ++cells.cell_loops[site.value() + 1];
        cells.edges.insert(cells.edges.end(), walked.begin() + begin, walked.begin() + end);
        cells.loop_edges.push_back(size_of(cells.edges));
    }
    add_up(cells.cell_loops);
}

Cells build_cells(const Diagram& diagram, Ticker ticker) {
    Cells cells;
    collect_loops(diagram, ticker, cells);
    collect_neighbours(diagram, ticker, cells);
    return cells;
}

}  // namespace agvd
