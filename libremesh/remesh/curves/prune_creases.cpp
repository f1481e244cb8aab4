// A chain's merit is the sum of length times weight over its edges. Chains with open ends are
// removed in order of merit, from a queue; chains that meet at a node with no third one left are
// joined. Then whole networks are judged.
#include "remesh/curves/prune_creases.h"

#include <algorithm>
#include <queue>

namespace remesh::detail {
namespace {

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
            here.erase(std::remove(here.begin(), here.end(), c), here.end());
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

void prune(CreaseSet& set, const std::vector<double>& weights, const PruningRules& rules,
           Poller& poller) {
    ChainGraph graph(set, weights, rules, poller);
    graph.remove_weak_ends();
    graph.remove_poor_networks();
}

}  // namespace remesh::detail
