// Joins narrow faces with neighbours into patches by a union-find over their sides, in order of
// merit. `narrow` is a height, mesh units.
#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "agvd/core/parallel.h"
#include "agvd/core/union_find.h"
#include "agvd/mesh/surface.h"
#include "remesh/curves/crease_chains.h"
#include "remesh/curves/curve_network.h"

namespace remesh::detail {
namespace {

constexpr Index edges_per_task = 4096;

// Faces joined into patches. A patch is named by its root.
struct Patches {
    UnionFind joined;
    std::vector<Vec3> area;       // #F: twice the vector area; at a root, of its patch.
    std::vector<double> longest;  // #F: longest side; at a root, of its patch.

    [[nodiscard]] bool is_narrow(Index root, double narrow) const {
        return area[root].norm() < narrow * longest[root];
    }
    void join(Index a, Index b) {
        if (b < a) std::swap(a, b);  // The root is the lower one.
        joined.unite(a, b);
        area[a] += area[b];
        longest[a] = std::max(longest[a], longest[b]);
    }
};

Patches single_faces(const Surface& surface, int num_threads, Poller& poller) {
    const Index count = surface.num_faces();
    Patches patches{UnionFind(count), std::vector<Vec3>(count), std::vector<double>(count)};
    const auto measure = [&](Index f) {
        patches.area[f] = doubled_normal(surface.mesh.positions, surface.mesh.triangles[f]);
        patches.longest[f] = std::max(
            {surface.length_of(3 * f), surface.length_of(3 * f + 1), surface.length_of(3 * f + 2)});
    };
    parallel_each(count, edges_per_task, num_threads, measure, poller);
    return patches;
}

// Ascending.
std::vector<Index> find_narrow_faces(const Surface& surface, const Patches& patches, double narrow,
                                     int num_threads, Poller& poller) {
    const auto find = [&](Index f, std::vector<Index>& found) {
        if (patches.is_narrow(f, narrow)) found.push_back(f);
    };
    return parallel_collect<Index>(surface.num_faces(), edges_per_task, num_threads, find, poller);
}

// A side of a narrow face, and the merit of joining the face across it: its length, less if the
// face across has another direction. The needle's own direction may be rounding, so such a side
// still counts for a tenth.
struct SharedSide {
    double merit;
    Index edge;
};

std::vector<SharedSide> sides_of_narrow_faces(const Surface& surface, const Patches& patches,
                                              double narrow, int num_threads, Poller& poller) {
    Ticker ticker(poller);
    std::vector<SharedSide> sides;
    for (const Index f : find_narrow_faces(surface, patches, narrow, num_threads, poller)) {
        ticker.tick();
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            const Index twin = surface.twin[h];
            if (twin == no_index) continue;
            const Index across = Surface::face(twin);
            if (across < f && patches.is_narrow(across, narrow)) continue;  // Added from there.
            double alike =
                (1 + patches.area[f].normalized().dot(patches.area[across].normalized())) / 2;
            for (int i = 0; i < 3; ++i) alike *= alike;  // To the eighth power.
            const double likeness = 0.1 + alike;
            sides.push_back({surface.length_of(h) * likeness, surface.edge[h]});
        }
    }
    sort_ticked(sides, ticker, [](const SharedSide& a, const SharedSide& b) {
        return a.merit != b.merit ? a.merit > b.merit : a.edge < b.edge;
    });
    return sides;
}

void join_narrow_faces(const Surface& surface, double narrow, int num_threads, Patches& patches,
                       Poller& poller) {
    Ticker ticker(poller);
    for (const SharedSide& side :
         sides_of_narrow_faces(surface, patches, narrow, num_threads, poller)) {
        ticker.tick();
        const Index h = surface.edge_half[side.edge];
        const Index a = patches.joined.root(Surface::face(h));
        const Index b = patches.joined.root(Surface::face(surface.twin[h]));
        if (a != b && (patches.is_narrow(a, narrow) || patches.is_narrow(b, narrow)))
            patches.join(a, b);
    }
}

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
            for_each_edge_at(surface_, v, [&, v = v, left = left](Index h, Index other) {
                ticker_.tick();
                pass(v, left, h, other);
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

std::vector<double> edge_angles(const Surface& surface, double narrow, int num_threads,
                                Poller& poller) {
    Patches patches = single_faces(surface, num_threads, poller);
    join_narrow_faces(surface, narrow, num_threads, patches, poller);
    std::vector<double> angles(surface.num_edges());
    const auto measure = [&](Index e) {
        const Index h = surface.edge_half[e];
        if (surface.twin[h] == no_index) return;
        const Index a = std::as_const(patches.joined).root(Surface::face(h));
        const Index b = std::as_const(patches.joined).root(Surface::face(surface.twin[h]));
        if (a != b) angles[e] = angle_between(patches.area[a], patches.area[b]);
    };
    parallel_each(surface.num_edges(), edges_per_task, num_threads, measure, poller);
    return angles;
}

std::vector<double> surrounding_turn(const CreaseSet& set, const std::vector<double>& angles,
                                     double reach, Poller& poller) {
    Gathering gathering(set, angles, reach, poller);
    gathering.spread();
    return gathering.of_edges();
}

}  // namespace remesh::detail
