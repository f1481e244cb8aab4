// The loops of cells, told from joined arcs.
#include <unordered_map>

#include "agvd/diagram/join.h"

namespace agvd {

// Follows the boundary of cells, the cell on the left.
class ArcJoiner::LoopCounter {
public:
    LoopCounter(const Surface& surface, const EdgeLabels& labels, const ArcStore& arcs,
                const ArcJoiner& joiner)
        : surface_(surface), labels_(labels), arcs_(arcs), in_(joiner) {}

    void run(const CellSet& cells, std::vector<Index>& count) {
        follow_boundary(cells, count);
        std::vector<std::uint8_t> is_seen(2 * in_.edges_.size(), 0);
        for (const Index edge : in_.order_) {
            for (Side side = 2 * edge; side < 2 * edge + 2; ++side) {
                const Index site = side % 2 == 0 ? in_.edges_[edge].left : in_.edges_[edge].right;
                if (!cells.has(site) || is_seen[side] != 0) continue;
                ++count[site];
                for (Side s = side; is_seen[s] == 0; s = next(s)) is_seen[s] = 1;
            }
        }
    }

private:
    // 2 * edge + (0: walked from its first end to its last, the left cell's; 1: the right cell's).
    using Side = Index;

    // Finds what follows on each label change on the boundary. A boundary without any is a loop.
    void follow_boundary(const CellSet& cells, std::vector<Index>& count) {
        for (const std::vector<Index>& loop : in_.boundary_loops_) {
            Index first = no_index, last = no_index;
            for (const Index h : loop) {
                const Block& row = labels_.edge_rows[surface_.edge[h]];
                for (Index node = row.begin; node < row.end(); ++node) {
                    if (first == no_index) {
                        first = node;
                    } else {
                        next_on_boundary_[last] = node;
                    }
                    last = node;
                }
            }
            const Index site = labels_.point_site[surface_.tail(loop[0])];
            if (first != no_index) {
                next_on_boundary_[last] = first;
            } else if (cells.has(site)) {
                ++count[site];
            }
        }
    }

    // Around a Voronoi vertex, a cell arrives along an end and leaves along the one before; at a
    // label change on the boundary it goes on along the boundary to the next one.
    [[nodiscard]] Side next(Side side) const {
        const Index edge = side / 2;
        if (in_.edges_[edge].is_closed()) return side;
        const ArcEnd arriving = side % 2 == 0 ? in_.edges_[edge].last : in_.first_ends_[edge];
        const Index node = node_at(arcs_, arriving);
        const ArcEnd leaving =
            node >= LocalDiagram::first_voronoi_vertex
                ? before_at_vertex(node - LocalDiagram::first_voronoi_vertex, arriving)
                : in_.crossing_ends_[next_on_boundary_.at(node)][0];
        const Index next_edge = in_.edge_of_arc_[leaving / 2];
        return 2 * next_edge + (in_.first_ends_[next_edge] == leaving ? 0 : 1);
    }

    [[nodiscard]] ArcEnd before_at_vertex(Index voronoi_vertex, ArcEnd end) const {
        const auto& ends = arcs_.voronoi_vertices()[voronoi_vertex].ends;
        return end == ends[0] ? ends[2] : end == ends[1] ? ends[0] : ends[1];
    }

    const Surface& surface_;
    const EdgeLabels& labels_;
    const ArcStore& arcs_;
    const ArcJoiner& in_;
    std::unordered_map<Index, Index> next_on_boundary_;  // By crossing.
};

std::vector<Index> ArcJoiner::count_loops(const Surface& surface, const EdgeLabels& labels,
                                          const ArcStore& arcs, const CellSet& cells) const {
    std::vector<Index> count(cells.num_sites(), 0);
    LoopCounter(surface, labels, arcs, *this).run(cells, count);
    return count;
}

}  // namespace agvd
