// A queue holds the cheapest allowed collapse of each vertex. Later passes ask less of the shape.
#include "remesh/dual/reduce_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>

#include "agvd/core/progress.h"
#include "agvd/mesh/any_mesh.h"
#include "remesh/dual/fan_mesh.h"

namespace remesh {
namespace {

using detail::FanMesh;

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

// The neighbours of a vertex, ascending.
std::vector<Index> ring_of(const FanMesh& mesh, Index v) {
    std::vector<Index> ring;
    for (const Index f : mesh.faces_at(v)) {
        for (const Index w : mesh.face(f).corner) {
            if (w != v) ring.push_back(w);
        }
    }
    return distinct(std::move(ring));
}

class Reducer {
public:
    using DoCollapse = std::function<bool(Index, Index)>;

    Reducer(std::span<const Vec3> positions, const FanMesh& mesh,
            std::span<const std::uint8_t> keep, const DoCollapse& collapse, Ticker ticker)
        : ticker_(ticker),
          positions_(positions),
          mesh_(mesh),
          collapse_(collapse),
          keep_(keep),
          stamp_(positions.size(), 0) {
        for (Index v = 0; v < mesh.num_vertices(); ++v) {
            if (!mesh.faces_at(v).empty()) ++num_vertices_;
        }
    }

    std::vector<Index> run(Index target) {
        for (const Demands& demands : passes) {
            if (num_vertices_ <= target) break;
            run_pass(demands, target);
        }
        return std::move(gone_);
    }

private:
    void run_pass(const Demands& demands, Index target) {
        demands_ = demands;
        queue_ = {};
        for (Index v = 0; v < mesh_.num_vertices(); ++v) judge(v);
        while (num_vertices_ > target && !queue_.empty()) {
            const Collapse next = queue_.top();
            queue_.pop();
            if (next.stamp != stamp_[next.gone] || mesh_.faces_at(next.gone).empty()) continue;
            if (!collapse_(next.gone, next.into)) {
                judge(next.gone, {next.cost, next.into});
                continue;
            }
            for (const Index w : ring_of(mesh_, next.into)) judge(w);
            judge(next.into);
            gone_.push_back(next.gone);
            --num_vertices_;
        }
    }

    // Queues the shortest collapse of v that is allowed, of those after one.
    void judge(Index v, const std::pair<double, Index>& after = {-1, 0}) {
        ++stamp_[v];
        if (mesh_.faces_at(v).empty()) return;
        if (!keep_.empty() && keep_[v] != 0 && !demands_.releases_kept) return;
        const std::vector<Index> ring = ring_of(mesh_, v);
        // The test of an edge looks at all pairs of faces of its two ends.
        ticker_.tick(4 + ring.size() * ring.size() / 4);
        std::vector<std::pair<double, Index>> ends;  // By squared distance.
        ends.reserve(ring.size());
        for (const Index w : ring) {
            ends.emplace_back((positions_[v] - positions_[w]).squaredNorm(), w);
        }
        std::sort(ends.begin(), ends.end());
        for (const auto& [square, w] : ends) {
            if (std::pair(square, w) <= after) continue;
            if (!mesh_.can_collapse(v, w) || !keeps_shape(v, w)) continue;
            queue_.push({square, v, w, stamp_[v]});
            return;
        }
    }

    [[nodiscard]] bool keeps_shape(Index gone, Index into) const {
        if (demands_.least_quality < 0) return true;
        const std::size_t num_faces = mesh_.faces_at(gone).size() + mesh_.faces_at(into).size();
        if (num_faces > demands_.most_faces + 4) return false;
        for (const Index f : mesh_.faces_at(gone)) {
            if (mesh_.has_corner(f, into)) continue;
            Triangle moved = mesh_.face(f).corner;
            std::replace(moved.begin(), moved.end(), gone, into);
            const Vec3 before = doubled_normal(positions_, mesh_.face(f).corner);
            const Vec3 after = doubled_normal(positions_, moved);
            if (!(after.dot(before) > demands_.least_turn * after.norm() * before.norm())) {
                return false;
            }
            if (quality(moved, after.norm()) < demands_.least_quality) return false;
        }
        return true;
    }

    [[nodiscard]] double quality(const Triangle& t, double twice_area) const {
        const double longest = std::max({(positions_[t[0]] - positions_[t[1]]).squaredNorm(),
                                         (positions_[t[1]] - positions_[t[2]]).squaredNorm(),
                                         (positions_[t[2]] - positions_[t[0]]).squaredNorm()});
        return 2 / std::numbers::sqrt3 * twice_area / longest;
    }

    Ticker ticker_;
    std::span<const Vec3> positions_;
    const FanMesh& mesh_;
    const DoCollapse& collapse_;
    std::span<const std::uint8_t> keep_;
    std::vector<std::uint32_t> stamp_;
    Index num_vertices_ = 0;
    Demands demands_ = passes[0];
    std::priority_queue<Collapse> queue_;
    std::vector<Index> gone_;
};

// Collapses an edge after flips of the edges that are in the way: they join `into` with neighbours
// of `gone`.
// \return false: it cannot be, and nothing has changed.
bool collapse_after_flips(FanMesh& mesh, Index gone, Index into) {
    const FanMesh::Mark before = mesh.mark();
    for (const Index w : ring_of(mesh, gone)) {
        const bool share_face = std::ranges::any_of(mesh.faces_at(gone), [&](Index f) {
            return mesh.has_corner(f, into) && mesh.has_corner(f, w);
        });
        const Index h = w == into || share_face ? no_index : mesh.half_edge(into, w);
        if (h != no_index && mesh.can_flip(h)) mesh.flip(h);
    }
    if (mesh.can_collapse(gone, into)) {
        mesh.collapse(gone, into);
        return true;
    }
    mesh.take_back(before);
    return false;
}

// Into the nearest neighbour that can be.
bool collapse_vertex(FanMesh& mesh, std::span<const Vec3> positions, Index gone) {
    std::vector<Index> ring = ring_of(mesh, gone);
    std::ranges::stable_sort(
        ring, {}, [&](Index w) { return (positions[w] - positions[gone]).squaredNorm(); });
    return std::ranges::any_of(ring, [&](Index w) { return collapse_after_flips(mesh, gone, w); });
}

}  // namespace

std::vector<Index> reduce_vertices(std::span<const Vec3> positions,
                                   std::vector<Triangle>& triangles, Index target,
                                   std::span<const std::uint8_t> keep, const Progress& progress) {
    Poller poller(progress);
    FanMesh mesh(triangles, static_cast<Index>(positions.size()), Ticker(poller));
    const Reducer::DoCollapse collapse = [&](Index vertex, Index into) {
        mesh.collapse(vertex, into);
        mesh.forget();
        return true;
    };
    std::vector<Index> gone = Reducer(positions, mesh, keep, collapse, Ticker(poller)).run(target);
    triangles = mesh.triangles();
    return gone;
}

void reduce_vertices(std::span<const Vec3> positions, const FanMesh& mesh, Index target,
                     const std::function<bool(Index, Index)>& collapse, const Progress& progress) {
    Poller poller(progress);
    (void)Reducer(positions, mesh, {}, collapse, Ticker(poller)).run(target);
}

SimplifiedMesh simplify_patch(const Surface& surface, std::span<const Index> faces,
                              std::span<const SurfacePoint> points) {
    SimplifiedMesh patch = simplify(surface, faces, points);
    if (patch.extra.empty()) return patch;
    std::vector<Vec3> positions;
    for (const auto some : {points, std::span<const SurfacePoint>(patch.extra)}) {
        for (const SurfacePoint& p : some) positions.push_back(position(surface.mesh.view(), p));
    }
    FanMesh mesh(patch.triangles, static_cast<Index>(positions.size()));
    for (bool is_changed = true; is_changed;) {
        is_changed = false;
        for (auto v = static_cast<Index>(points.size()); v < positions.size(); ++v) {
            if (mesh.faces_at(v).empty()) continue;
            is_changed = collapse_vertex(mesh, positions, v) || is_changed;
        }
    }
    patch.triangles = mesh.triangles();
    std::vector<SurfacePoint> left;  // All points are vertices.
    for (const Index v : drop_unused(mesh.num_vertices(), patch.triangles)) {
        if (v >= points.size()) left.push_back(patch.extra[v - points.size()]);
    }
    patch.extra = std::move(left);
    return patch;
}

}  // namespace remesh
