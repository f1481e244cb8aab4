#include "remesh/curves/crease_chains.h"

#include <algorithm>
#include <cstring>

#include "agvd/mesh/surface.h"

namespace remesh::detail {
namespace {

// The second edge of the set at an inner vertex.
Index other_edge(const CreaseSet& set, Index vertex, Index edge) {
    Index other = no_index;
    for_each_outgoing(set.surface(), vertex, [&](Index h) {
        const Index e = set.surface().edge[h];
        if (e != edge && set.has(e)) other = e;
    });
    return other;
}

Index other_vertex(const Surface& surface, Index edge, Index vertex) {
    const Index h = surface.edge_half[edge];
    return surface.tail(h) == vertex ? surface.head(h) : surface.tail(h);
}

// Appends the edges after `edge`, through `vertex` to the end of the chain. Returns the vertex
// there.
Index follow(const CreaseSet& set, Index edge, Index vertex, std::vector<Index>& edges) {
    const Index first = edge;
    while (set.is_inner(vertex)) {
        edge = other_edge(set, vertex, edge);
        if (edge == first) break;  // Around a closed chain.
        edges.push_back(edge);
        vertex = other_vertex(set.surface(), edge, vertex);
    }
    return vertex;
}

}  // namespace

Index CreaseSet::next(Index edge) const {
    const std::size_t num_left = is_in_.size() - edge;
    if (num_left == 0) return edge;
    const void* found = std::memchr(is_in_.data() + edge, 1, num_left);
    return found == nullptr
               ? static_cast<Index>(is_in_.size())
               : static_cast<Index>(static_cast<const std::uint8_t*>(found) - is_in_.data());
}

CreaseChain chain_of(const CreaseSet& set, Index edge) {
    const Surface& surface = set.surface();
    const Index h = surface.edge_half[edge];
    CreaseChain chain;
    chain.ends[0] = follow(set, edge, surface.tail(h), chain.edges);
    const bool is_closed = chain.ends[0] == surface.head(h) && set.is_inner(chain.ends[0]);
    std::reverse(chain.edges.begin(), chain.edges.end());
    chain.edges.push_back(edge);
    chain.ends[1] = is_closed ? chain.ends[0] : follow(set, edge, surface.head(h), chain.edges);
    for (const Index e : chain.edges) chain.length += surface.length[e];
    return chain;
}

std::vector<CreaseChain> chains_of(const CreaseSet& set, Poller& poller) {
    Ticker ticker(poller);
    std::vector<std::uint8_t> is_done(set.surface().num_edges());
    std::vector<CreaseChain> chains;
    for (Index e = set.next(0); e < set.surface().num_edges(); e = set.next(e + 1)) {
        ticker.tick();
        if (is_done[e]) continue;
        chains.push_back(chain_of(set, e));
        for (const Index other : chains.back().edges) is_done[other] = 1;
    }
    return chains;
}

}  // namespace remesh::detail
