#include "remesh/curves/surrounding_turn.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "agvd/mesh/surface.h"

namespace remesh::detail {
namespace {

// Each vertex of the set gathers the turn around it, as far as it is the nearest such vertex.
class Gathering {
public:
    Gathering(const CreaseSet& set, const std::vector<double>& angles, double reach, Poller& poller)
        : set_(set), surface_(set.surface()), angles_(angles), ticker_(poller) {
        const Index count = surface_.num_vertices();
        crease_length_.resize(count);
        turn_.resize(count);
        left_.resize(count);
        source_.assign(count, no_index);
        for (Index e = set.next(0); e < surface_.num_edges(); e = set.next(e + 1)) {
            const Index h = surface_.edge_half[e];
            crease_length_[surface_.tail(h)] += surface_.length[e] / 2;
            crease_length_[surface_.head(h)] += surface_.length[e] / 2;
        }
        for (Index v = 0; v < count; ++v) {
            if (set.degree(v) == 0) continue;
            source_[v] = v;
            left_[v] = std::clamp(2 * crease_length_[v] / set.degree(v), reach, 4 * reach);
            queue_.emplace(left_[v], v);
        }
    }

    void spread() {
        while (!queue_.empty()) {
            const auto [left, v] = queue_.top();
            queue_.pop();
            if (left < left_[v]) continue;
            for_each_outgoing(surface_, v, [&, v = v, left = left](Index h) {
                ticker_.tick();
                pass(v, left, h, surface_.head(h));
                const Index last = Surface::previous(h);  // No half-edge leaves along it.
                if (surface_.twin[last] == no_index) pass(v, left, last, surface_.tail(last));
            });
        }
    }

    [[nodiscard]] std::vector<double> of_edges() const {
        std::vector<double> turns(surface_.num_edges());
        for (Index e = set_.next(0); e < surface_.num_edges(); e = set_.next(e + 1)) {
            const Index h = surface_.edge_half[e];
            for (const Index v : {surface_.tail(h), surface_.head(h)}) {
                turns[e] += std::sqrt(turn_[v] / crease_length_[v]) / 2;
            }
        }
        return turns;
    }

private:
    // Passes along half-edge h from v, which is settled with `left` of its reach remaining, to
    // `other`.
    void pass(Index v, double left, Index h, Index other) {
        const Index e = surface_.edge[h];
        if (set_.has(e)) return;
        const double length = surface_.length[e];
        // An edge between two settled vertices is gathered from both, each up to where they meet.
        const bool is_met = source_[other] != no_index && left_[other] >= left;
        const double part = is_met ? (length + left - left_[other]) / 2 : length;
        turn_[source_[v]] += angles_[e] * angles_[e] * std::clamp(std::min(part, left), 0., length);
        if (left - length > left_[other]) {
            left_[other] = left - length;
            source_[other] = source_[v];
            queue_.emplace(left_[other], other);
        }
    }

    const CreaseSet& set_;
    const Surface& surface_;
    const std::vector<double>& angles_;
    Ticker ticker_;
    std::vector<double> crease_length_;  // #V: half the length of the edges of the set there.
    std::vector<double> turn_;           // #V: gathered; radians times length.
    std::vector<double> left_;           // #V: reach that remains at the vertex.
    std::vector<Index> source_;          // #V: the vertex of the set that it belongs to.
    std::priority_queue<std::pair<double, Index>> queue_;
};

}  // namespace

std::vector<double> surrounding_turn(const CreaseSet& set, const std::vector<double>& angles,
                                     double reach, Poller& poller) {
    Gathering gathering(set, angles, reach, poller);
    gathering.spread();
    return gathering.of_edges();
}

}  // namespace remesh::detail
