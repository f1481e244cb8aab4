#include "agvd/diagram/join.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace agvd {

bool ArcJoiner::is_vertex(Index node) const {
    return node >= LocalDiagram::first_voronoi_vertex || crossing_ends_[node][1] == no_index;
}

// The other arc's end at a crossing.
ArcJoiner::ArcEnd ArcJoiner::across(const ArcStore& arcs, ArcEnd end) const {
    const auto& ends = crossing_ends_[node_at(arcs, end)];
    return ends[0] == end ? ends[1] : ends[0];
}

void ArcJoiner::forget(const ArcStore& arcs, Index face) {
    forgotten_.push_back(face);
    const Block& block = arcs.of_face(face).arcs;
    for (Index arc = block.begin; arc < block.end() && arc < edge_of_arc_.size(); ++arc) {
        const Index edge = std::exchange(edge_of_arc_[arc], no_index);
        if (edge != no_index) first_ends_[edge] = no_index;
    }
    for (ArcEnd end = tail_of(block.begin); end < tail_of(block.end()); ++end) {
        const Index node = node_at(arcs, end);
        if (node >= crossing_ends_.size()) continue;  // A Voronoi vertex, or not joined yet.
        auto& ends = crossing_ends_[node];
        if (ends[0] == end) ends[0] = std::exchange(ends[1], no_index);
        if (ends[1] == end) ends[1] = no_index;
    }
}

// One call of join().
class ArcJoiner::Run {
public:
    Run(const EdgeLabels& labels, const ArcStore& arcs, Ticker ticker, ArcJoiner& joiner)
        : labels_(labels), arcs_(arcs), ticker_(ticker), in_(joiner) {}

    void run(std::span<const Index> new_faces) {
        std::vector<Index> gone;
        std::erase_if(in_.order_, [&](Index name) {
            if (in_.first_ends_[name] != no_index) return false;
            gone.push_back(name);
            return true;
        });
        register_ends(new_faces);
        add_open_edges(new_faces);
        add_other_edges(new_faces);
        // All their arcs are of other edges by now: where a face was kept, they lead into one that
        // was not.
        in_.free_edges_.insert(in_.free_edges_.end(), gone.begin(), gone.end());
        list_voronoi_vertices(new_faces);
    }

private:
    void register_ends(std::span<const Index> new_faces) {
        in_.edge_of_arc_.resize(arcs_.arcs().size(), no_index);
        in_.crossing_ends_.resize(labels_.crossings.size(), {no_index, no_index});
        for (const Index face : new_faces) {
            const Block& block = arcs_.of_face(face).arcs;
            ticker_.tick(1 + block.count);
            for (Index arc = block.begin; arc < block.end(); ++arc) {
                for (const ArcEnd end : {tail_of(arc), head_of(arc)}) {
                    const Index node = node_at(end);
                    if (node >= LocalDiagram::first_voronoi_vertex) continue;
                    auto& ends = in_.crossing_ends_[node];
                    assert(ends[1] == no_index);
                    ends[ends[0] == no_index ? 0 : 1] = end;
                }
            }
        }
    }

    [[nodiscard]] Index node_at(ArcEnd end) const { return ArcJoiner::node_at(arcs_, end); }
    [[nodiscard]] bool is_vertex(Index node) const { return in_.is_vertex(node); }
    [[nodiscard]] ArcEnd across(ArcEnd end) const { return in_.across(arcs_, end); }
    [[nodiscard]] bool is_joined(Index arc) const {
        const Index edge = in_.edge_of_arc_[arc];
        return edge != no_index && in_.first_ends_[edge] != no_index;
    }

    // Edges come in the order of the faces, and of the ends in a face, closed ones behind.
    [[nodiscard]] std::uint64_t key_of(ArcEnd end, bool is_closed) const {
        const Index face = arcs_.arcs()[end / 2].face;
        const ArcEnd first = tail_of(arcs_.of_face(face).arcs.begin);
        return (std::uint64_t{is_closed} << 63) | (std::uint64_t{face} << 31) | (end - first);
    }

    // Those one of whose ends is new.
    void add_open_edges(std::span<const Index> new_faces) {
        for (const Index face : new_faces) {
            const Block& block = arcs_.of_face(face).arcs;
            ticker_.tick(1 + block.count);
            for (ArcEnd end = tail_of(block.begin); end < tail_of(block.end()); ++end) {
                if (!is_joined(end / 2) && is_vertex(node_at(end))) add_edge(end, false);
            }
        }
    }

    // Those that come from old faces and lead to old faces, and closed ones.
    void add_other_edges(std::span<const Index> new_faces) {
        for (const Index face : new_faces) {
            const Block& block = arcs_.of_face(face).arcs;
            ticker_.tick(1 + block.count);
            for (Index arc = block.begin; arc < block.end(); ++arc) {
                if (!is_joined(arc)) add_edge_through(arc);
            }
        }
    }

    void add_edge_through(Index arc) {
        ArcEnd from = tail_of(arc);
        ArcEnd lowest = from;
        while (true) {
            const ArcEnd to = other_end(from);
            if (is_vertex(node_at(to))) {
                add_edge(to, false);
                return;
            }
            from = across(to);
            if (from / 2 == arc) break;
            const ArcEnd tail = tail_of(from / 2);
            if (key_of(tail, true) < key_of(lowest, true)) lowest = tail;
        }
        add_edge(lowest, true);
    }

    // Follows the arcs from one end through crossings until a Voronoi vertex or the start.
    void add_edge(ArcEnd start, bool is_closed) {
        if (in_.free_edges_.empty()) {
            in_.free_edges_.push_back(static_cast<Index>(in_.edges_.size()));
            in_.edges_.emplace_back();
            in_.first_ends_.push_back(no_index);
        }
        const Index name = in_.free_edges_.back();
        in_.free_edges_.pop_back();
        in_.order_.push_back(name);
        ArcEnd from = start;
        ArcEnd to;
        while (true) {
            in_.edge_of_arc_[from / 2] = name;
            ticker_.tick();
            to = other_end(from);
            if (!is_closed && is_vertex(node_at(to))) break;
            from = across(to);
            if (from == start) break;
        }
        if (!is_closed && key_of(to, false) < key_of(start, false)) std::swap(start, to);
        const LocalArc& arc = arcs_.arcs()[start / 2];
        const bool forward = start % 2 == 0;
        in_.first_ends_[name] = start;
        in_.edges_[name] = {key_of(start, is_closed),
                            to,
                            forward ? arc.left : arc.right,
                            forward ? arc.right : arc.left,
                            0,
                            0,
                            true};
    }

    void list_voronoi_vertices(std::span<const Index> new_faces) {
        std::sort(in_.forgotten_.begin(), in_.forgotten_.end());
        auto forgotten = in_.forgotten_.begin();
        std::erase_if(in_.voronoi_vertices_, [&](const FaceVoronoiVertices& old) {
            forgotten = std::lower_bound(forgotten, in_.forgotten_.end(), old.face);
            return forgotten != in_.forgotten_.end() && *forgotten == old.face;
        });
        in_.forgotten_.clear();
        const auto num_old = static_cast<std::ptrdiff_t>(in_.voronoi_vertices_.size());
        for (const Index face : new_faces) {
            const Block& voronoi_vertices = arcs_.of_face(face).voronoi_vertices;
            if (voronoi_vertices.count > 0)
                in_.voronoi_vertices_.push_back({face, voronoi_vertices});
        }
        std::inplace_merge(in_.voronoi_vertices_.begin(), in_.voronoi_vertices_.begin() + num_old,
                           in_.voronoi_vertices_.end(),
                           [](const FaceVoronoiVertices& a, const FaceVoronoiVertices& b) {
                               return a.face < b.face;
                           });
    }

    const EdgeLabels& labels_;
    const ArcStore& arcs_;
    Ticker ticker_;
    ArcJoiner& in_;
};

void ArcJoiner::join(const EdgeLabels& labels, const ArcStore& arcs,
                     std::span<const Index> new_faces, Ticker ticker) {
    Run(labels, arcs, ticker, *this).run(new_faces);
}

void ArcJoiner::renumber(const Renumbering& renumbering) {
    for (Edge& edge : edges_) {
        renumbering.apply(edge.left);
        renumbering.apply(edge.right);
    }
}

std::vector<Index> ArcJoiner::faces_beside(const ArcStore& arcs, const CellSet& cells) const {
    std::vector<Index> faces;
    for (const Index name : order_) {
        const Edge& edge = edges_[name];
        if (cells.has(edge.left) || cells.has(edge.right)) {
            faces.push_back(arcs.arcs()[first_ends_[name] / 2].face);
        }
    }
    return faces;
}

}  // namespace agvd
