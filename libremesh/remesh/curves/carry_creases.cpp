// Gaps are closed by Dijkstra's algorithm along weak edges, the shortest first. Open ends that are
// left follow weak edges that turn little.
#include <algorithm>
#include <numbers>
#include <optional>
#include <queue>
#include <unordered_map>

#include "agvd/mesh/surface.h"
#include "remesh/curves/crease_chains.h"

namespace remesh::detail {
namespace {

// Along a chain, the two ends of a gap are at least this many gap lengths apart.
constexpr double least_detour = 3;
constexpr double most_turn_cos = std::numbers::sqrt2 / 2;

// An open end and the chain that ends there.
struct OpenEnd {
    Index vertex = no_index;
    const CreaseChain* chain = nullptr;
    Vec3 ahead;  // Unit vector: direction of the chain's last edge.
};

std::vector<OpenEnd> open_ends(const CreaseSet& set, const std::vector<CreaseChain>& chains) {
    const Surface& surface = set.surface();
    std::vector<OpenEnd> ends;
    for (const CreaseChain& chain : chains) {
        for (const int k : {0, 1}) {
            const Index v = chain.ends[k];
            if (!set.is_open_end(v)) continue;
            const Index before =
                other_end(surface, k == 0 ? chain.edges.front() : chain.edges.back(), v);
            const auto& p = surface.mesh.positions;
            ends.push_back({v, &chain, (p[v] - p[before]).normalized()});
        }
    }
    return ends;
}

struct Path {
    double length = 0;
    Index from = no_index;
    Index to = no_index;
    std::vector<Index> edges;
};

class GapSearch {
public:
    GapSearch(const CreaseSet& set, const std::vector<double>& angles, const CarryRules& rules,
              Poller& poller)
        : set_(set), surface_(set.surface()), angles_(angles), rules_(rules), ticker_(poller) {}

    // The shortest path from an open end to a vertex of the set or the boundary ahead of it.
    std::optional<Path> run(const OpenEnd& end) {
        const double most = std::min(rules_.most_gap, end.chain->length);
        reached_.clear();
        queue_ = {};
        reached_[end.vertex] = {0, no_index, no_index};
        queue_.emplace(0, end.vertex);
        while (!queue_.empty()) {
            const auto [length, v] = queue_.top();
            queue_.pop();
            if (length > reached_[v].length) continue;
            if (v != end.vertex && (set_.degree(v) > 0 || surface_.is_boundary_vertex(v))) {
                if (is_ahead(end, v, length)) return path_to(end.vertex, v);
                continue;
            }
            for_each_edge_at(surface_, v, [&, v = v, length = length](Index h, Index other) {
                ticker_.tick();
                const Index e = surface_.edge[h];
                const double beyond = length + surface_.length[e];
                if (set_.has(e) || angles_[e] < rules_.least_angle || beyond > most) return;
                const auto [it, is_new] = reached_.try_emplace(other, Step{beyond, v, e});
                if (!is_new && it->second.length <= beyond) return;
                it->second = {beyond, v, e};
                queue_.emplace(beyond, other);
            });
        }
        return std::nullopt;
    }

private:
    struct Step {
        double length;
        Index from;
        Index edge;
    };

    [[nodiscard]] bool is_ahead(const OpenEnd& end, Index v, double length) const {
        const auto& p = surface_.mesh.positions;
        if ((p[v] - p[end.vertex]).dot(end.ahead) <= 0) return false;
        double along = 0;  // A vertex of the same chain must be far along the chain.
        const bool is_from_front = end.chain->ends[0] == end.vertex;
        const std::size_t count = end.chain->edges.size();
        for (std::size_t i = 0; i < count; ++i) {
            const Index e = end.chain->edges[is_from_front ? i : count - 1 - i];
            along += surface_.length[e];
            if (along > least_detour * length) return true;
            const Index h = surface_.edge_half[e];
            if (surface_.tail(h) == v || surface_.head(h) == v) return false;
        }
        return true;
    }

    [[nodiscard]] Path path_to(Index from, Index to) const {
        Path path{reached_.at(to).length, from, to, {}};
        for (Index v = to; v != from; v = reached_.at(v).from) {
            path.edges.push_back(reached_.at(v).edge);
        }
        return path;
    }

    const CreaseSet& set_;
    const Surface& surface_;
    const std::vector<double>& angles_;
    const CarryRules& rules_;
    Ticker ticker_;
    std::unordered_map<Index, Step> reached_;
    std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>,
                        std::greater<>>
        queue_;
};

// The sharpest weak edge that turns by at most 45 degrees; no_index if there is none.
Index next_weak_edge(const CreaseSet& set, const std::vector<double>& angles, double least_angle,
                     Index vertex, const Vec3& ahead) {
    const auto& p = set.surface().mesh.positions;
    Index best = no_index;
    for_each_edge_at(set.surface(), vertex, [&](Index h, Index other) {
        const Index e = set.surface().edge[h];
        if (set.has(e) || angles[e] < least_angle) return;
        if ((p[other] - p[vertex]).normalized().dot(ahead) < most_turn_cos) return;
        if (best == no_index || angles[e] > angles[best]) best = e;
    });
    return best;
}

}  // namespace

void close_gaps(CreaseSet& set, const std::vector<double>& angles, const CarryRules& rules,
                Poller& poller) {
    const std::vector<CreaseChain> chains = chains_of(set, poller);
    GapSearch search(set, angles, rules, poller);
    std::vector<Path> paths;
    for (const OpenEnd& end : open_ends(set, chains)) {
        std::optional<Path> path = search.run(end);
        if (path) paths.push_back(std::move(*path));
    }
    std::sort(paths.begin(), paths.end(), [](const Path& a, const Path& b) {
        return a.length != b.length ? a.length < b.length : a.from < b.from;
    });
    for (const Path& path : paths) {
        if (!set.is_open_end(path.from)) continue;
        for (const Index e : path.edges) set.add(e);
    }
}

void extend_ends(CreaseSet& set, const std::vector<double>& angles, const CarryRules& rules,
                 Poller& poller) {
    const Surface& surface = set.surface();
    const auto& p = surface.mesh.positions;
    Ticker ticker(poller);
    const std::vector<CreaseChain> chains = chains_of(set, poller);
    for (const OpenEnd& end : open_ends(set, chains)) {
        double left = end.chain->length;
        Index v = end.vertex;
        Vec3 ahead = end.ahead;
        while (set.is_open_end(v)) {
            ticker.tick();
            const Index e = next_weak_edge(set, angles, rules.least_angle, v, ahead);
            if (e == no_index || surface.length[e] > left) break;
            left -= surface.length[e];
            const Index other = other_end(surface, e, v);
            ahead = (p[other] - p[v]).normalized();
            set.add(e);
            v = other;
        }
    }
}

}  // namespace remesh::detail
