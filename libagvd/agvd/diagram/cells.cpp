// Areas are whole numbers of 2^-61 of the surface's area, so that sums do not depend on the order.
// The Euler characteristic is the alternating sum of a cell's faces, intervals and points.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "agvd/diagram/stages.h"
#include "agvd/mesh/surface.h"

namespace agvd {
namespace {

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

class CellTally {
public:
    CellTally(const Surface& surface, const DiagramParts& parts, Index num_sites)
        : surface_(surface), labels_(parts.labels), arcs_(parts.arcs), cells_(num_sites) {
        const double area = surface_area(surface);
        constexpr int bits = 61;
        constexpr int least_exponent = -1000;  // Its inverse is finite, too.
        if (area > 0) unit_ = std::ldexp(1.0, std::max(std::ilogb(area) - bits, least_exponent));
    }

    void count_faces(Ticker& ticker) {
        for (Index f = 0; f < surface_.num_faces(); ++f) {
            ticker.tick();
            if (labels_.mixed_index[f] == no_index) {
                // At least one unit: a cell that owns a face is not empty.
                const std::int64_t area = std::max(units(face_area(surface_, f)), std::int64_t{1});
                count(labels_.point_site[surface_.mesh.triangles[f][0]], 1, area);
                continue;
            }
            const FaceArcs& face = arcs_.faces[labels_.mixed_index[f]];
            for (const CellPart& part : elements_of(arcs_.parts, face.parts)) {
                count(part.site, part.pieces, units(part.area));
            }
        }
    }

    void write(Diagram& diagram) const {
        for (const Cell& cell : cells_) {
            diagram.cell_area.push_back(static_cast<double>(cell.area) * unit_);
            diagram.cell_euler.push_back(cell.euler);
        }
    }

private:
    struct Cell {
        std::int64_t area = 0;  // In units.
        int euler = 0;
    };

    void count(Index site, int euler, std::int64_t area = 0) {
        if (site == no_index) return;
        Cell& cell = cells_[site];
        cell.euler += euler;
        // Wraps where areas are wrong.
        cell.area = static_cast<std::int64_t>(static_cast<std::uint64_t>(cell.area) +
                                              static_cast<std::uint64_t>(area));
    }

    [[nodiscard]] std::int64_t units(double area) const {
        const double count = area * (1 / unit_);
        // A needle of 10^15 times its width has lost its digits.
        constexpr double most = 0x1p62;
        return std::abs(count) <= most ? std::llrint(count) : 0;
    }

    const Surface& surface_;
    const EdgeLabels& labels_;
    const Arcs& arcs_;
    double unit_ = 1;  // Of area: a power of two.
    std::vector<Cell> cells_;
};

}  // namespace

void count_points_and_edges(const Surface& surface, const EdgeLabels& labels,
                            std::span<int> euler) {
    const auto count = [&](Index site, int change) {
        if (site != no_index) euler[site] += change;
    };
    // One boundary edge leaves each vertex of the boundary, and both are left out.
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        if (surface.outgoing[v] != no_index) count(labels.point_site[v], 1);
    }
    for (const InnerPoint& point : labels.inner_points) count(point.site, 1);
    // The first interval of an edge has the label of the tail of its edge_half.
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        count(labels.point_site[surface.tail(h)], -1);
        if (surface.twin[h] == no_index) continue;
        for (const Crossing& crossing : labels.on_edge(e)) count(crossing.site_after, -1);
    }
    for (const Cut& cut : labels.cuts) {
        for (const Crossing& crossing : elements_of(labels.crossings, cut.row)) {
            count(crossing.site_before, -1);
        }
        count(labels.point_site[cut.to.point], -1);
    }
}

void measure_cells(const Surface& surface, const DiagramParts& parts, Ticker ticker,
                   Diagram& diagram) {
    CellTally tally(surface, parts, diagram.num_sites);
    tally.count_faces(ticker);
    tally.write(diagram);
    count_points_and_edges(surface, parts.labels, diagram.cell_euler);
}

void collect_loops(const Diagram& diagram, Ticker& ticker, Cells& cells) {
    struct Loop {
        SiteId site;
        Index begin, end;  // Of `walked`.
    };
    const std::vector<Side> next = next_sides(diagram);
    std::vector<LoopEdge> walked;
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
