// The search floods from face to face across the edges that meet the ball: what it visits is the
// connected part of the surface in the ball, and nothing else.
#include "remesh/transfer/nearest_on_sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "agvd/mesh/any_mesh.h"

namespace remesh::detail {

namespace {

// As a share of the largest coordinate: a sum of three products of corners and barycentric
// coordinates, on the caller's mesh and on the cleaned one, differs by less.
constexpr double rounding_share = 16 * std::numeric_limits<double>::epsilon();
// The ball reaches farther than the start by this share, so that edges through the start meet it.
constexpr double margin = 1e-9;

// Vertices at equal positions become the first of them.
std::vector<Triangle> welded(const MeshView& mesh, Ticker ticker) {
    const std::vector<Index> first = first_at_position(mesh.positions, ticker);
    std::vector<Triangle> triangles(mesh.triangles.begin(), mesh.triangles.end());
    for_each_ticked(triangles, ticker, [&](Triangle& t) {
        for (Index& v : t) v = first[v];
    });
    return triangles;
}

}  // namespace

bool NearestOnSheet::Seen::insert(Index face) {
    if (2 * count_ >= slots_.size()) grow();
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = (face * std::size_t{0x9E3779B1}) & mask;
    while (slots_[i].round == round_) {
        if (slots_[i].face == face) return false;
        i = (i + 1) & mask;
    }
    slots_[i] = {face, round_};
    ++count_;
    return true;
}

void NearestOnSheet::Seen::grow() {
    const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
    count_ = 0;
    for (const Slot& slot : old) {
        if (slot.round == round_) insert(slot.face);
    }
}

NearestOnSheet::NearestOnSheet(const MeshView& mesh, Ticker ticker)
    : mesh_(mesh),
      points_(welded(mesh, ticker)),
      faces_(triangles_by_vertex(points_, mesh.positions.size())) {
    double largest = 0;
    for (const Vec3& p : mesh.positions) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    rounding_ = rounding_share * largest;
}

// The other faces at edge k of a face, but for those beyond a seam.
template <typename Visit>
void NearestOnSheet::for_each_neighbor(Index face, std::size_t k, const Visit& visit) const {
    const Index a = points_[face][k], b = points_[face][(k + 1) % 3];
    for (const Index other : faces_.of(a)) {
        const std::size_t at_b = corner_at(other, b);
        if (at_b == 3 || other == face) continue;
        if (agree_ != nullptr && !((*agree_)(face, k, other, corner_at(other, a)) &&
                                   (*agree_)(face, (k + 1) % 3, other, at_b))) {
            continue;
        }
        visit(other);
    }
}

// The corner of a face at a point; 3: it has none there.
std::size_t NearestOnSheet::corner_at(Index face, Index point) const {
    const Triangle& t = points_[face];
    return static_cast<std::size_t>(std::find(t.begin(), t.end(), point) - t.begin());
}

ClosestPoint NearestOnSheet::closest(Index face, const Vec3& point) const {
    const auto& [a, b, c] = mesh_.triangles[face];
    return closest_point_on_triangle({mesh_.positions[a], mesh_.positions[b], mesh_.positions[c]},
                                     FaceId(face), point);
}

// Visits the faces connected with one in the ball around a point, until visit() says false.
template <typename Visit>
void NearestOnSheet::flood(const Vec3& point, double reach, Index start, Seen& seen,
                           const Visit& visit) const {
    seen.clear();
    std::vector<Index> waiting{start};
    seen.insert(start);
    while (!waiting.empty()) {
        const Index face = waiting.back();
        waiting.pop_back();
        if (!visit(face)) return;
        const Triangle& t = mesh_.triangles[face];
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 &a = mesh_.positions[t[k]], &b = mesh_.positions[t[(k + 1) % 3]];
            if (distance_to_segment(point, a, b) > reach) continue;
            for_each_neighbor(face, k, [&](Index neighbor) {
                if (seen.insert(neighbor)) waiting.push_back(neighbor);
            });
        }
    }
}

ClosestPoint NearestOnSheet::query(const Vec3& point, const SurfacePoint& start, Seen& seen) const {
    ClosestPoint best{start, position(mesh_, start), 0};
    best.distance_sq = (best.position - point).squaredNorm();
    if (best.distance_sq <= rounding_ * rounding_) return best;
    const double reach = (1 + margin) * std::sqrt(best.distance_sq);
    flood(point, reach, start.face.value(), seen, [&](Index face) {
        const ClosestPoint here = closest(face, point);
        if (here.distance_sq < best.distance_sq) best = here;
        return true;
    });
    return best;
}

bool NearestOnSheet::are_connected(const Vec3& point, double radius, Index a, Index b,
                                   Seen& seen) const {
    bool is_found = false;
    flood(point, std::max(radius, rounding_), a, seen, [&](Index face) {
        is_found = face == b;
        return !is_found;
    });
    return is_found;
}

}  // namespace remesh::detail
