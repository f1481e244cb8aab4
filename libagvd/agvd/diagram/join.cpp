// Follows arcs from crossing to crossing. An edge is taken apart when one of its faces loses its
// arcs; the arcs that it leaves in other faces are joined again. Keys give the edges an order that
// depends on the faces alone and not on the changes before.
#include "agvd/diagram/join.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace agvd {
namespace {

// What all passes read and write.
struct Joining {
    const ArcStore& arcs;
    Ticker ticker;
    JoinedEdges& joined;
};

bool is_joined(const JoinedEdges& joined, Index arc) {
    const Index name = joined.edge_of_arc[arc];
    return name != no_index && joined.first_ends[name].is_valid();
}

// Ascends with the faces, and with the ends in a face; closed edges have the highest keys.
std::uint64_t key_of(const ArcStore& arcs, ArcEnd end, bool is_closed) {
    const Index face = arcs.arcs()[end.arc()].face;
    return (std::uint64_t{is_closed} << 63) | (std::uint64_t{face} << 31) |
           end.place_from(arcs.of_face(face).arcs.begin);
}

// Takes the edges that are gone out of the order.
std::vector<Index> remove_gone_edges(JoinedEdges& joined) {
    std::vector<Index> gone;
    std::erase_if(joined.order, [&](Index name) {
        if (joined.first_ends[name].is_valid()) return false;
        gone.push_back(name);
        return true;
    });
    return gone;
}

void register_ends(std::span<const Index> new_faces, Index num_crossings, Joining& at) {
    at.joined.edge_of_arc.resize(at.arcs.arcs().size(), no_index);
    at.joined.crossing_ends.resize(num_crossings);
    for (const Index face : new_faces) {
        const Block& block = at.arcs.of_face(face).arcs;
        at.ticker.tick(1 + block.count);
        for (Index arc = block.begin; arc < block.end(); ++arc) {
            for (const ArcEnd end : {ArcEnd::tail_of(arc), ArcEnd::head_of(arc)}) {
                const NodeId node = node_at(at.arcs, end);
                if (node.is_voronoi_vertex()) continue;
                auto& ends = at.joined.crossing_ends[node.crossing()];
                assert(!ends[1].is_valid());
                ends[ends[0].is_valid() ? 1 : 0] = end;
            }
        }
    }
}

Index take_name(JoinedEdges& joined) {
    if (joined.free_names.empty()) {
        joined.free_names.push_back(static_cast<Index>(joined.edges.size()));
        joined.edges.emplace_back();
        joined.first_ends.emplace_back();
    }
    const Index name = joined.free_names.back();
    joined.free_names.pop_back();
    return name;
}

// Follows the arcs from one end through crossings until a vertex or the start.
void add_edge(ArcEnd start, bool is_closed, Joining& at) {
    JoinedEdges& joined = at.joined;
    const Index name = take_name(joined);
    joined.order.push_back(name);
    ArcEnd from = start;
    ArcEnd to;
    while (true) {
        joined.edge_of_arc[from.arc()] = name;
        at.ticker.tick();
        to = from.other();
        if (!is_closed && ends_edges(joined, node_at(at.arcs, to))) break;
        from = across(at.arcs, joined, to);
        assert(from.is_valid());
        if (from == start) break;
    }
    if (!is_closed && key_of(at.arcs, to, false) < key_of(at.arcs, start, false)) {
        std::swap(start, to);
    }
    const LocalArc& arc = at.arcs.arcs()[start.arc()];
    joined.first_ends[name] = start;
    joined.edges[name] = {key_of(at.arcs, start, is_closed), to,
                          start.is_tail() ? arc.left : arc.right,
                          start.is_tail() ? arc.right : arc.left};
}

// Those one of whose ends is new.
void add_open_edges(std::span<const Index> new_faces, Joining& at) {
    for (const Index face : new_faces) {
        const Block& block = at.arcs.of_face(face).arcs;
        at.ticker.tick(1 + block.count);
        for (Index arc = block.begin; arc < block.end(); ++arc) {
            for (const ArcEnd end : {ArcEnd::tail_of(arc), ArcEnd::head_of(arc)}) {
                if (!is_joined(at.joined, arc) && ends_edges(at.joined, node_at(at.arcs, end))) {
                    add_edge(end, false, at);
                }
            }
        }
    }
}

void add_edge_through(Index arc, Joining& at) {
    ArcEnd from = ArcEnd::tail_of(arc);
    ArcEnd lowest = from;
    while (true) {
        const ArcEnd to = from.other();
        if (ends_edges(at.joined, node_at(at.arcs, to))) {
            add_edge(to, false, at);
            return;
        }
        from = across(at.arcs, at.joined, to);
        if (from.arc() == arc) break;
        const ArcEnd tail = ArcEnd::tail_of(from.arc());
        if (key_of(at.arcs, tail, true) < key_of(at.arcs, lowest, true)) lowest = tail;
    }
    add_edge(lowest, true, at);
}

// Those both of whose ends are in old faces, and closed ones.
void add_other_edges(std::span<const Index> new_faces, Joining& at) {
    for (const Index face : new_faces) {
        const Block& block = at.arcs.of_face(face).arcs;
        at.ticker.tick(1 + block.count);
        for (Index arc = block.begin; arc < block.end(); ++arc) {
            if (!is_joined(at.joined, arc)) add_edge_through(arc, at);
        }
    }
}

// \param num_old  at the beginning of the order, by key.
void sort_by_key(std::ptrdiff_t num_old, JoinedEdges& joined) {
    const auto comes_before = [&](Index a, Index b) {
        return joined.edges[a].key < joined.edges[b].key;
    };
    const auto first_new = joined.order.begin() + num_old;
    std::sort(first_new, joined.order.end(), comes_before);
    std::inplace_merge(joined.order.begin(), first_new, joined.order.end(), comes_before);
}

}  // namespace

void forget_arcs(const ArcStore& arcs, Index face, JoinedEdges& joined) {
    const Block& block = arcs.of_face(face).arcs;
    for (Index arc = block.begin; arc < block.end(); ++arc) {
        if (arc >= joined.edge_of_arc.size()) return;  // Not joined yet.
        const Index name = std::exchange(joined.edge_of_arc[arc], no_index);
        if (name != no_index) joined.first_ends[name] = {};
        for (const ArcEnd end : {ArcEnd::tail_of(arc), ArcEnd::head_of(arc)}) {
            const NodeId node = node_at(arcs, end);
            if (node.is_voronoi_vertex()) continue;
            auto& ends = joined.crossing_ends[node.crossing()];
            assert(ends[0] == end || ends[1] == end);
            if (ends[0] == end) ends[0] = std::exchange(ends[1], {});
            if (ends[1] == end) ends[1] = {};
        }
    }
}

void join_arcs(const EdgeLabels& labels, const ArcStore& arcs, std::span<const Index> new_faces,
               Ticker ticker, JoinedEdges& joined) {
    const std::vector<Index> gone = remove_gone_edges(joined);
    const auto num_old = static_cast<std::ptrdiff_t>(joined.order.size());
    Joining at{arcs, ticker, joined};
    register_ends(new_faces, labels.crossings.size(), at);
    add_open_edges(new_faces, at);
    add_other_edges(new_faces, at);
    sort_by_key(num_old, joined);
    // All arcs of the edges that are gone have other names by now: where an old face kept its arcs
    // they lead to a new face.
    joined.free_names.insert(joined.free_names.end(), gone.begin(), gone.end());
}

}  // namespace agvd
