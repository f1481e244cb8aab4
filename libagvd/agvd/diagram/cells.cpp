#include "agvd/diagram/cells.h"

#include <algorithm>
#include <functional>

namespace agvd {
namespace {

// Side of an edge: 2 * edge + (0: left cell, walked tail to head; 1: right cell, head to tail).
using Side = Index;

[[nodiscard]] SiteId site_of(const Diagram& diagram, Side side) {
    const VoronoiEdge& edge = diagram.edges[side / 2];
    return side % 2 == 0 ? edge.left : edge.right;
}

// The side that follows on the same cell's loop. Where an edge arrives at a vertex, its cell lies
// clockwise before it; the loop goes on along the end that this cell follows.
[[nodiscard]] std::vector<Side> next_sides(const Diagram& diagram) {
    std::vector<Side> next(2 * diagram.edges.size());
    for (Side side = 0; side < next.size(); ++side) next[side] = side;  // Closed curves.
    for (Index v = 0; v + 1 < diagram.vertex_offsets.size(); ++v) {
        const Index begin = diagram.vertex_offsets[v];
        const Index valence = diagram.vertex_offsets[v + 1] - begin;
        for (Index i = 0; i < valence; ++i) {
            // The cell between end i and end i + 1 leaves along end i and arrives along end i + 1.
            const EdgeEnd& out = diagram.vertex_ends[begin + i];
            const EdgeEnd& in = diagram.vertex_ends[begin + (i + 1) % valence];
            const Side leaving = 2 * out.edge + (out.is_tail ? 0 : 1);
            const Side arriving = 2 * in.edge + (in.is_tail ? 1 : 0);
            next[arriving] = leaving;
        }
    }
    return next;
}

void collect_loops(const Diagram& diagram, Ticker& ticker, Cells& cells) {
    const std::vector<Side> next = next_sides(diagram);
    std::vector<std::vector<DirectedEdge>> loops;
    std::vector<std::pair<SiteId, Index>> loop_of;  // (site, loop)
    std::vector<bool> seen(next.size(), false);
    for (Side start = 0; start < next.size(); ++start) {
        if (seen[start] || !site_of(diagram, start).is_valid()) continue;
        loop_of.emplace_back(site_of(diagram, start), static_cast<Index>(loops.size()));
        auto& loop = loops.emplace_back();
        for (Side side = start; !seen[side]; side = next[side]) {
            ticker.tick();
            seen[side] = true;
            loop.push_back({side / 2, side % 2 == 1});
        }
    }
    std::sort(loop_of.begin(), loop_of.end());
    cells.cell_loops.assign(diagram.num_sites + 1, 0);
    cells.loop_edges.assign(1, 0);
    for (const auto& [site, loop] : loop_of) {
        ++cells.cell_loops[site.value() + 1];
        cells.edges.insert(cells.edges.end(), loops[loop].begin(), loops[loop].end());
        cells.loop_edges.push_back(static_cast<Index>(cells.edges.size()));
    }
    for (Index s = 0; s < diagram.num_sites; ++s) cells.cell_loops[s + 1] += cells.cell_loops[s];
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
    for (Index s = 0; s < diagram.num_sites; ++s) {
        cells.neighbour_offsets[s + 1] += cells.neighbour_offsets[s];
    }
}

}  // namespace

Cells build_cells(const Diagram& diagram, Ticker ticker) {
    Cells cells;
    collect_loops(diagram, ticker, cells);
    collect_neighbours(diagram, ticker, cells);
    return cells;
}

}  // namespace agvd
