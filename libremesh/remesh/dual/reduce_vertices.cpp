// Collapses the shortest edges first, from a queue that holds the cheapest allowed collapse of each
// vertex. Every collapse meets the link condition ([dey1999]), which keeps the topology. Five
// passes over all edges ask less and less of the shape, and each begins only if the one before has
// not reached the target.
#include "remesh/dual/reduce_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>

#include "agvd/core/progress.h"

namespace remesh {
namespace {

// What a collapse must keep; each pass asks for less.
struct Demands {
    double least_turn;     // Cosine of the angle between a face's normals before and after.
    double least_quality;  // 2 / sqrt(3) times the height over the longest side, as in quality().
    std::size_t most_faces;
    bool releases_kept;
};
constexpr std::array<Demands, 5> passes = {
    {{0.5, 0.3, 9, false},
     {0.0, 0.05, 14, false},
     {0.0, 1e-9, no_index, false},  // Slivers, none without area.
     {-2.0, -1.0, no_index, false},
     {-2.0, -1.0, no_index, true}}};

struct Collapse {
    double cost;
    Index gone, into;
    std::uint32_t stamp;  // Of `gone` when it was queued.

    // Puts the cheapest on top of a heap.
    [[nodiscard]] bool operator<(const Collapse& other) const {
        return cost != other.cost ? cost > other.cost : gone > other.gone;
    }
};

class Reducer {
public:
    Reducer(std::span<const Vec3> positions, std::vector<Triangle>& triangles,
            std::span<const std::uint8_t> keep, Ticker ticker)
        : ticker_(ticker),
          positions_(positions),
          triangles_(triangles),
          keep_(keep),
          faces_of_(positions.size()),
          is_on_boundary_(positions.size(), 0),
          stamp_(positions.size(), 0),
          is_gone_(triangles.size(), 0) {
        for (Index f = 0; f < triangles.size(); ++f) {
            for (const Index v : triangles[f]) faces_of_[v].push_back(f);
        }
        for (Index v = 0; v < faces_of_.size(); ++v) {
            if (!faces_of_[v].empty()) ++num_vertices_;
            collect_ring(v);
            ticker_.tick(1 + ring_.size());
            for (const Index w : ring_) {
                if (num_faces_at(v, w) == 1) is_on_boundary_[v] = 1;
            }
        }
    }

    std::vector<Index> run(Index target) {
        for (const Demands& demands : passes) {
            if (num_vertices_ <= target) break;
            run_pass(demands, target);
        }
        Index num_left = 0;
        for (Index f = 0; f < triangles_.size(); ++f) {
            if (is_gone_[f] == 0) triangles_[num_left++] = triangles_[f];
        }
        triangles_.resize(num_left);
        return std::move(gone_);
    }

private:
    void run_pass(const Demands& demands, Index target) {
        demands_ = demands;
        queue_ = {};
        for (Index v = 0; v < faces_of_.size(); ++v) judge(v);
        while (num_vertices_ > target && !queue_.empty()) {
            const Collapse next = queue_.top();
            queue_.pop();
            if (next.stamp != stamp_[next.gone] || faces_of_[next.gone].empty()) continue;
            apply(next);
            gone_.push_back(next.gone);
            --num_vertices_;
        }
    }

    void collect_ring(Index v) {
        ring_.clear();
        for (const Index f : faces_of_[v]) {
            for (const Index w : triangles_[f]) {
                if (w != v) ring_.push_back(w);
            }
        }
        std::sort(ring_.begin(), ring_.end());
        ring_.erase(std::unique(ring_.begin(), ring_.end()), ring_.end());
    }

    [[nodiscard]] bool has_corner(Index face, Index v) const {
        const Triangle& t = triangles_[face];
        return t[0] == v || t[1] == v || t[2] == v;
    }

    [[nodiscard]] std::size_t num_faces_at(Index v, Index w) const {
        return static_cast<std::size_t>(std::count_if(faces_of_[v].begin(), faces_of_[v].end(),
                                                      [&](Index f) { return has_corner(f, w); }));
    }

    // Queues the shortest collapse of v that is allowed.
    void judge(Index v) {
        ++stamp_[v];
        if (faces_of_[v].empty()) return;
        if (!keep_.empty() && keep_[v] != 0 && !demands_.releases_kept) return;
        collect_ring(v);
        // The test of an edge looks at all pairs of faces of its two ends.
        ticker_.tick(4 + ring_.size() * ring_.size() / 4);
        ends_.clear();
        for (const Index w : ring_) {
            ends_.emplace_back((positions_[v] - positions_[w]).squaredNorm(), w);
        }
        std::sort(ends_.begin(), ends_.end());
        for (const auto& [square, w] : ends_) {
            if (!keeps_topology(v, w) || !keeps_shape(v, w)) continue;
            queue_.push({square, v, w, stamp_[v]});
            return;
        }
    }

    // Expects the one-ring of `gone` in ring_.
    [[nodiscard]] bool keeps_topology(Index gone, Index into) const {
        std::array<Index, 2> apex{no_index, no_index};
        std::size_t num_apexes = 0;
        for (const Index f : faces_of_[gone]) {
            if (!has_corner(f, into)) continue;
            for (const Index w : triangles_[f]) {
                if (w != gone && w != into) apex[num_apexes++] = w;
            }
        }
        if (is_on_boundary_[gone] != 0 && num_apexes == 2) return false;
        // A single triangle: the apex has no other face.
        if (num_apexes == 1 && faces_of_[apex[0]].size() == 1) return false;
        std::size_t num_common = 0;
        for (const Index w : ring_) {
            if (w != into && num_faces_at(into, w) > 0) ++num_common;
        }
        if (num_common != num_apexes) return false;
        return num_apexes == 1 || !(has_face(gone, apex[0], apex[1]) &&  //
                                    has_face(into, apex[0], apex[1]));
    }

    [[nodiscard]] bool has_face(Index v, Index a, Index b) const {
        return std::any_of(faces_of_[v].begin(), faces_of_[v].end(),
                           [&](Index f) { return has_corner(f, a) && has_corner(f, b); });
    }

    [[nodiscard]] bool keeps_shape(Index gone, Index into) const {
        if (demands_.least_quality < 0) return true;
        if (faces_of_[gone].size() + faces_of_[into].size() > demands_.most_faces + 4) return false;
        for (const Index f : faces_of_[gone]) {
            if (has_corner(f, into)) continue;
            Triangle moved = triangles_[f];
            std::replace(moved.begin(), moved.end(), gone, into);
            const Vec3 before = normal(triangles_[f]);
            const Vec3 after = normal(moved);
            if (!(after.dot(before) > demands_.least_turn * after.norm() * before.norm())) {
                return false;
            }
            if (quality(moved, after.norm()) < demands_.least_quality) return false;
        }
        return true;
    }

    // Its length is twice the triangle's area.
    [[nodiscard]] Vec3 normal(const Triangle& t) const {
        return (positions_[t[1]] - positions_[t[0]]).cross(positions_[t[2]] - positions_[t[0]]);
    }

    [[nodiscard]] double quality(const Triangle& t, double twice_area) const {
        const double longest = std::max({(positions_[t[0]] - positions_[t[1]]).squaredNorm(),
                                         (positions_[t[1]] - positions_[t[2]]).squaredNorm(),
                                         (positions_[t[2]] - positions_[t[0]]).squaredNorm()});
        return 2 / std::numbers::sqrt3 * twice_area / longest;
    }

    void apply(const Collapse& collapse) {
        const auto [cost, gone, into, stamp] = collapse;
        for (const Index f : faces_of_[gone]) {
            if (has_corner(f, into)) {
                is_gone_[f] = 1;
                for (const Index w : triangles_[f]) {
                    if (w != gone) std::erase(faces_of_[w], f);
                }
            } else {
                std::replace(triangles_[f].begin(), triangles_[f].end(), gone, into);
                faces_of_[into].push_back(f);
            }
        }
        faces_of_[gone].clear();
        collect_ring(into);
        const std::vector<Index> changed = ring_;
        for (const Index w : changed) judge(w);
        judge(into);
    }

    Ticker ticker_;
    std::span<const Vec3> positions_;
    std::vector<Triangle>& triangles_;
    std::span<const std::uint8_t> keep_;
    std::vector<std::vector<Index>> faces_of_;  // #V; empty: the vertex is gone.
    std::vector<std::uint8_t> is_on_boundary_;
    std::vector<std::uint32_t> stamp_;
    std::vector<std::uint8_t> is_gone_;  // By face.
    Index num_vertices_ = 0;
    Demands demands_ = passes[0];
    std::priority_queue<Collapse> queue_;
    std::vector<Index> gone_;
    std::vector<Index> ring_;                     // Scratch: one-ring, ascending.
    std::vector<std::pair<double, Index>> ends_;  // Scratch: neighbours by squared distance.
};

}  // namespace

std::vector<Index> reduce_vertices(std::span<const Vec3> positions,
                                   std::vector<Triangle>& triangles, Index target,
                                   std::span<const std::uint8_t> keep, const Progress& progress) {
    Poller poller(progress);
    return Reducer(positions, triangles, keep, Ticker(poller)).run(target);
}

}  // namespace remesh
