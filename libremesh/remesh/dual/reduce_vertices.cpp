// A queue holds the cheapest allowed collapse of each vertex; each meets the link condition
// ([dey1999]). Later passes ask less of the shape.
#include "remesh/dual/reduce_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <queue>

#include "agvd/core/progress.h"
#include "remesh/curves/glue.h"

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

// Of the points and the extra vertices.
std::vector<Vec3> positions_of(const Surface& surface, std::span<const SurfacePoint> points,
                               const SimplifiedMesh& patch) {
    std::vector<Vec3> positions;
    for (const auto some : {points, std::span<const SurfacePoint>(patch.extra)}) {
        for (const SurfacePoint& p : some) positions.push_back(position(surface.mesh.view(), p));
    }
    return positions;
}

// The corner of a triangle that has the directed edge (a, b).
struct Wing {
    Index triangle, apex;
};

std::optional<Wing> find_wing(const std::vector<Triangle>& triangles, Index a, Index b) {
    for (Index i = 0; i < triangles.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Triangle& t = triangles[i];
            if (t[k] == a && t[(k + 1) % 3] == b) return Wing{i, t[(k + 2) % 3]};
        }
    }
    return std::nullopt;
}

// Flips the inner edge between a and b if there is one and its apexes are not joined.
void flip_between(Index a, Index b, std::vector<Triangle>& triangles) {
    const auto left = find_wing(triangles, a, b), right = find_wing(triangles, b, a);
    if (!left || !right || left->apex == right->apex) return;
    if (find_wing(triangles, left->apex, right->apex)) return;
    if (find_wing(triangles, right->apex, left->apex)) return;
    triangles[left->triangle] = {left->apex, right->apex, b};
    triangles[right->triangle] = {right->apex, left->apex, a};
}

// Removes one vertex of the boundary, if that is possible.
bool remove_vertex(Index v, const DirectedEdge& neighbours, const std::vector<Vec3>& positions,
                   Index num_vertices, std::vector<Triangle>& triangles) {
    std::vector<Triangle> fewer = triangles;
    flip_between(neighbours.first, neighbours.second, fewer);
    std::vector<std::uint8_t> keep(positions.size(), 1);
    keep[v] = 0;
    const std::vector<Index> gone = reduce_vertices(positions, fewer, num_vertices - 1, keep);
    if (gone.size() != 1 || gone.front() != v) return false;
    triangles = std::move(fewer);
    return true;
}

}  // namespace

std::vector<Index> reduce_vertices(std::span<const Vec3> positions,
                                   std::vector<Triangle>& triangles, Index target,
                                   std::span<const std::uint8_t> keep, const Progress& progress) {
    Poller poller(progress);
    return Reducer(positions, triangles, keep, Ticker(poller)).run(target);
}

void free_rim(const Surface& surface, std::span<const SurfacePoint> points, SimplifiedMesh& patch) {
    if (patch.extra.empty()) return;
    const std::vector<Vec3> positions = positions_of(surface, points, patch);
    std::vector<bool> is_gone(patch.extra.size(), false);
    auto num_vertices = static_cast<Index>(positions.size());
    for (Index i = 0; i < is_gone.size(); ++i) {
        const auto v = static_cast<Index>(points.size()) + i;
        std::array<Index, 2> neighbours{no_index, no_index};
        for (const auto& [from, to] : rim_of(patch.triangles)) {
            if (to == v) neighbours[0] = from;
            if (from == v) neighbours[1] = to;
        }
        if (neighbours[0] == no_index) continue;
        is_gone[i] = remove_vertex(v, {neighbours[0], neighbours[1]}, positions, num_vertices,
                                   patch.triangles);
        if (is_gone[i]) --num_vertices;
    }
    std::vector<Index> number(points.size());
    for (Index v = 0; v < number.size(); ++v) number[v] = v;
    std::vector<SurfacePoint> left;
    for (Index i = 0; i < is_gone.size(); ++i) {
        number.push_back(static_cast<Index>(points.size() + left.size()));
        if (!is_gone[i]) left.push_back(patch.extra[i]);
    }
    patch.extra = std::move(left);
    for (Triangle& t : patch.triangles) {
        for (Index& v : t) v = number[v];
    }
}

SimplifiedMesh simplify_patch(const Surface& surface, std::span<const Index> faces,
                              std::span<const SurfacePoint> points) {
    SimplifiedMesh patch = simplify(surface, faces, points);
    if (patch.extra.empty()) return patch;
    const std::vector<Vec3> positions = positions_of(surface, points, patch);
    std::vector<std::uint8_t> keep(points.size(), 1);
    keep.resize(positions.size(), 0);
    std::vector<Triangle> triangles = patch.triangles;
    const std::vector<Index> gone =
        reduce_vertices(positions, triangles, static_cast<Index>(points.size()), keep);
    const bool are_extra =
        std::all_of(gone.begin(), gone.end(), [&](Index v) { return v >= points.size(); });
    if (are_extra && gone.size() == patch.extra.size()) {
        patch.triangles = std::move(triangles);
        patch.extra.clear();
    }
    return patch;
}

}  // namespace remesh
