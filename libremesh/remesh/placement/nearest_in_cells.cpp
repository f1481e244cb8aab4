#include "remesh/placement/nearest_in_cells.h"

#include <algorithm>
#include <limits>

#include "agvd/mesh/surface.h"

namespace remesh::detail {

namespace {

// Most faces passed on the way to a nearer point.
constexpr int most_faces_passed = 1000;

}  // namespace

NearestInCells::NearestInCells(const IntrinsicTriangulation& base,
                               std::span<const Index> nearest_vertex, Index num_cells)
    : base_(base), input_(base.input()), begin_(std::size_t{num_cells} + 1, 0) {
    for (const Index cell : nearest_vertex) {
        if (cell != no_index) ++begin_[std::size_t{cell} + 1];
    }
    for (std::size_t cell = 0; cell < num_cells; ++cell) begin_[cell + 1] += begin_[cell];
    vertices_.resize(begin_.back());
    at_.resize(begin_.back());
    std::vector<Index> next(begin_.begin(), begin_.end() - 1);
    for (Index v = 0; v < nearest_vertex.size(); ++v) {
        if (nearest_vertex[v] == no_index) continue;
        const Index slot = next[nearest_vertex[v]]++;
        vertices_[slot] = v;
        at_[slot] = base.surface().mesh.positions[v];
    }
}

ClosestPoint NearestInCells::query(const Vec3& point, std::span<const Index> cells) const {
    ClosestPoint result;
    result.distance_sq = std::numeric_limits<double>::infinity();
    double least = result.distance_sq;
    Index nearest = no_index;
    for (const Index cell : cells) {
        for (Index slot = begin_[cell]; slot < begin_[cell + 1]; ++slot) {
            const double distance_sq = (at_[slot] - point).squaredNorm();
            if (distance_sq >= least) continue;
            least = distance_sq;
            nearest = vertices_[slot];
        }
    }
    if (nearest == no_index) return result;
    if (nearest >= input_.num_vertices()) {
        result = closest(base_.place_of_added(nearest).face.value(), point);
    } else {
        for_each_outgoing(input_, nearest, [&](Index h) {
            const ClosestPoint here = closest(Surface::face(h), point);
            if (here.distance_sq < result.distance_sq) result = here;
        });
    }
    descend(point, nearest, result);
    return result;
}

ClosestPoint NearestInCells::closest(Index face, const Vec3& point) const {
    const auto& [a, b, c] = input_.mesh.triangles[face];
    const auto& p = input_.mesh.positions;
    return closest_point_on_triangle({p[a], p[b], p[c]}, FaceId(face), point);
}

// Walks from face to face while these are nearer. The faces around the vertex may be needles, with
// the nearest point on a face beyond them.
void NearestInCells::descend(const Vec3& point, Index vertex, ClosestPoint& nearest) const {
    const Surface& base = base_.surface();
    const Vec3& start = base.mesh.positions[vertex];
    double reach = 0;
    for_each_outgoing(base, vertex, [&](Index h) { reach = std::max(reach, base.length_of(h)); });
    bool is_nearer = true;
    for (int step = 0; step < most_faces_passed && is_nearer; ++step) {
        is_nearer = false;
        const SurfacePoint from = nearest.point;
        for (Index k = 0; k < 3; ++k) {  // Across the edges that the point lies on.
            const Index twin = input_.twin[3 * from.face.value() + k];
            if (from.barycentric[(k + 2) % 3] != 0 || twin == no_index) continue;
            const ClosestPoint beyond = closest(Surface::face(twin), point);
            if (!(beyond.distance_sq < nearest.distance_sq)) continue;
            if ((beyond.position - start).squaredNorm() > reach * reach) continue;
            nearest = beyond;
            is_nearer = true;
        }
    }
}

}  // namespace remesh::detail
