#include "remesh/placement/nearest_in_cells.h"

#include <limits>

namespace remesh::detail {

using agvd::Index;
using agvd::no_index;
using agvd::Surface;
using agvd::Vec3;

NearestInCells::NearestInCells(const Surface& surface, std::span<const Index> nearest_vertex,
                               Index num_cells)
    : surface_(surface), begin_(std::size_t{num_cells} + 1, 0) {
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
        at_[slot] = surface.mesh.positions[v];
    }
}

agvd::ClosestPoint NearestInCells::query(const Vec3& point, std::span<const Index> cells) const {
    agvd::ClosestPoint result;
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
    if (nearest == no_index || surface_.outgoing[nearest] == no_index) return result;
    const auto& p = surface_.mesh.positions;
    const Index first = surface_.outgoing[nearest];
    Index h = first;
    do {
        const Index face = Surface::face(h);
        const auto& [a, b, c] = surface_.mesh.triangles[face];
        const agvd::ClosestPoint here =
            agvd::closest_point_on_triangle({p[a], p[b], p[c]}, agvd::FaceId(face), point);
        if (here.distance_sq < result.distance_sq) result = here;
        h = surface_.twin[Surface::previous(h)];
    } while (h != no_index && h != first);
    return result;
}

}  // namespace remesh::detail
