// Chains with open ends are removed in order of merit; those that meet at a node with no third one
// left are joined. Then networks are judged.
#include <algorithm>
#include <array>
#include <cstring>
#include <queue>

#include "agvd/core/union_find.h"
#include "agvd/mesh/surface.h"
#include "remesh/curves/crease_chains.h"

namespace remesh::detail {
namespace {

// The edge of the set at a vertex that is not `edge`, where there is one such.
Index other_edge(const CreaseSet& set, Index vertex, Index edge) {
    Index other = no_index;
    for_each_outgoing(set.surface(), vertex, [&](Index h) {
        const Index e = set.surface().edge[h];
        if (e != edge && set.has(e)) other = e;
    });
    return other;
}

// Appends the edges after `edge`, through `vertex` to the end of the chain. Returns the vertex
// there.
Index follow(const CreaseSet& set, Index edge, Index vertex, std::vector<Index>& edges) {
    const Index first = edge;
    while (set.is_inner(vertex)) {
        edge = other_edge(set, vertex, edge);
        if (edge == first) break;  // Around a closed chain.
        edges.push_back(edge);
        vertex = other_end(set.surface(), edge, vertex);
    }
    return vertex;
}

// The chain that holds the edge.
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

// The chains as a graph. Two chains are joined when a third one is removed at their node: the
// shorter list is appended to the longer.
class ChainGraph {
public:
    ChainGraph(CreaseSet& set, const std::vector<double>& weights, const PruningRules& rules,
               Poller& poller)
        : set_(set), rules_(rules), ticker_(poller), chains_(chains_of(set, poller)) {
        incident_.resize(set.surface().num_vertices());
        merit_.resize(chains_.size());
        is_gone_.resize(chains_.size());
        for (Index c = 0; c < chains_.size(); ++c) {
            ticker_.tick(chains_[c].edges.size());
            for (const Index e : chains_[c].edges) {
                merit_[c] += weights[e] * set.surface().length[e];
            }
            for (const Index v : chains_[c].ends) incident_[v].push_back(c);
        }
    }

    // Removes the chain of least merit first: the chains that it branched from may then be one.
    void remove_weak_ends() {
        for (Index c = 0; c < chains_.size(); ++c) enqueue(c);
        while (!queue_.empty()) {
            ticker_.tick();
            const auto [merit, c] = queue_.top();
            queue_.pop();
            if (is_gone_[c] || merit != merit_[c] || merit >= least_merit(c)) continue;
            remove(c);
        }
    }

    void remove_poor_networks() {
        std::vector<std::uint8_t> is_seen(chains_.size());
        for (Index c = 0; c < chains_.size(); ++c) {
            if (is_gone_[c] || is_seen[c]) continue;
            std::vector<Index> network{c};
            is_seen[c] = 1;
            double length = 0, merit = 0;
            for (std::size_t i = 0; i < network.size(); ++i) {
                ticker_.tick();
                const CreaseChain& chain = chains_[network[i]];
                length += chain.length;
                merit += merit_[network[i]] * std::min(1., chain.length / rules_.short_chain);
                for (const Index v : chain.ends) {
                    for (const Index other : incident_[v]) {
                        if (is_seen[other]) continue;
                        is_seen[other] = 1;
                        network.push_back(other);
                    }
                }
            }
            if (merit >= std::max(rules_.least_network, rules_.least_density * length)) continue;
            for (const Index other : network) drop_edges(other);
        }
    }

private:
    [[nodiscard]] double least_merit(Index c) const {
        const auto& [a, b] = chains_[c].ends;
        if (a == b) return set_.degree(a) == 2 ? 0 : rules_.least_spur;
        const int open = (set_.is_open_end(a) ? 1 : 0) + (set_.is_open_end(b) ? 1 : 0);
        return open == 0 ? 0 : open == 1 ? rules_.least_spur : rules_.least_island;
    }

    void enqueue(Index c) {
        if (merit_[c] < least_merit(c)) queue_.emplace(merit_[c], c);
    }

    void drop_edges(Index c) {
        for (const Index e : chains_[c].edges) set_.remove(e);
        is_gone_[c] = 1;
    }

    void remove(Index c) {
        drop_edges(c);
        const auto ends = chains_[c].ends;
        for (int k = 0; k < 2; ++k) {
            auto& here = incident_[ends[k]];
            std::erase(here, c);
            if (k == 1 && ends[0] == ends[1]) continue;
            if (set_.is_inner(ends[k]) && here.size() == 2) join(ends[k], here[0], here[1]);
            for (const Index other : incident_[ends[k]]) enqueue(other);
        }
    }

    // Joins two chains, or the two ends of one, at a vertex where no other chain is left.
    void join(Index vertex, Index a, Index b) {
        if (a == b) {
            chains_[a].ends[0] = chains_[a].ends[1] = vertex;
            return;
        }
        if (chains_[a].edges.size() < chains_[b].edges.size()) std::swap(a, b);
        const Index far = chains_[b].ends[chains_[b].ends[0] == vertex ? 1 : 0];
        chains_[a].ends[chains_[a].ends[0] == vertex ? 0 : 1] = far;
        chains_[a].edges.insert(chains_[a].edges.end(), chains_[b].edges.begin(),
                                chains_[b].edges.end());
        chains_[a].length += chains_[b].length;
        merit_[a] += merit_[b];
        is_gone_[b] = 1;
        incident_[vertex].clear();
        std::replace(incident_[far].begin(), incident_[far].end(), b, a);
        enqueue(a);
    }

    CreaseSet& set_;
    const PruningRules& rules_;
    Ticker ticker_;
    std::vector<CreaseChain> chains_;
    std::vector<double> merit_;                 // #chains.
    std::vector<std::uint8_t> is_gone_;         // #chains.
    std::vector<std::vector<Index>> incident_;  // #V: chains that end there, a closed one twice.
    std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>,
                        std::greater<>>
        queue_;
};

}  // namespace

Index CreaseSet::next(Index edge) const {
    const std::size_t num_left = is_in_.size() - edge;
    if (num_left == 0) return edge;
    const void* found = std::memchr(is_in_.data() + edge, 1, num_left);
    return found == nullptr
               ? static_cast<Index>(is_in_.size())
               : static_cast<Index>(static_cast<const std::uint8_t*>(found) - is_in_.data());
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

void prune(CreaseSet& set, const std::vector<double>& weights, const PruningRules& rules,
           Poller& poller) {
    ChainGraph graph(set, weights, rules, poller);
    graph.remove_weak_ends();
    graph.remove_poor_networks();
}

}  // namespace remesh::detail

namespace remesh {
namespace {

// In spacings. Narrower patches have few vertices that are not on their border, and the result lies
// far from the surface there.
constexpr double least_width = 2.5;
// Specks go first, so that their borders do not make the charts around them narrow.
constexpr std::array width_shares = {0.125, 0.25, 0.5, 1.0};
constexpr double least_seam_spur = 2;  // In spacings, as for junctions.

void drop_narrow_charts(const Surface& surface, double width, std::vector<std::uint8_t>& is_seam,
                        Ticker& ticker) {
    UnionFind charts(surface.num_faces());
    for (Index e = 0; e < surface.num_edges(); ++e) {
        ticker.tick();
        const Index h = surface.edge_half[e], twin = surface.twin[h];
        if (is_seam[e] == 0 && twin != no_index) {
            charts.unite(Surface::face(h), Surface::face(twin));
        }
    }
    std::vector<double> area(surface.num_faces(), 0), length(surface.num_faces(), 0);  // At roots.
    for (Index f = 0; f < surface.num_faces(); ++f) {
        ticker.tick();
        const Index chart = charts.root(f);
        area[chart] += doubled_normal(surface.mesh.positions, surface.mesh.triangles[f]).norm() / 2;
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            if (is_seam[surface.edge[h]] != 0) length[chart] += surface.length[surface.edge[h]];
        }
    }
    const auto is_narrow = [&](Index half_edge) {
        const Index chart = charts.root(Surface::face(half_edge));
        return 2 * area[chart] < width * length[chart];
    };
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        if (is_seam[e] != 0 && (is_narrow(h) || is_narrow(surface.twin[h]))) is_seam[e] = 0;
    }
}

// Removes short chains with a free end, one after the other.
void drop_spurs(const Surface& surface, std::span<const std::uint8_t> is_crease,
                double least_length, std::vector<std::uint8_t>& is_seam, Ticker& ticker) {
    detail::CreaseSet seams(surface);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        if (is_seam[e] != 0) seams.add(e);
        if (is_crease.empty() || is_crease[e] == 0) continue;
        const Index h = surface.edge_half[e];
        seams.anchor(surface.tail(h));
        seams.anchor(surface.head(h));
    }
    std::vector<Index> ends;
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        if (seams.is_open_end(v)) ends.push_back(v);
    }
    while (!ends.empty()) {
        const Index end = ends.back();
        ends.pop_back();
        if (!seams.is_open_end(end)) continue;
        const Index first = detail::other_edge(seams, end, no_index);
        std::vector<Index> chain{first};
        const Index far = detail::follow(seams, first, other_end(surface, first, end), chain);
        double length = 0;
        for (const Index e : chain) length += surface.length[e];
        ticker.tick(chain.size() + 1);
        if (!(length < least_length)) continue;
        for (const Index e : chain) seams.remove(e);
        if (seams.is_open_end(far)) ends.push_back(far);
    }
    is_seam = seams.take_flags();
}

}  // namespace

void prune_seams(const Surface& surface, std::span<const std::uint8_t> is_crease, double spacing,
                 std::vector<std::uint8_t>& is_seam, Ticker ticker) {
    for (const double share : width_shares) {
        drop_narrow_charts(surface, share * least_width * spacing, is_seam, ticker);
    }
    drop_spurs(surface, is_crease, least_seam_spur * spacing, is_seam, ticker);
}

}  // namespace remesh
