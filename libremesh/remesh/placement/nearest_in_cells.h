//! \file
//! Nearest points of a surface to points of the dual of its cells.
#pragma once

#include <algorithm>
#include <span>

#include "agvd/core/groups.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Searches the faces around the nearest vertex in a few cells, then walks from face to face while
//! the distance falls: quick, and never to the far side of a wall.
class NearestInCells {
public:
    //! \param base            outlives this.
    //! \param nearest_vertex  per vertex of the base: in whose cell it lies; no_index: none.
    NearestInCells(const IntrinsicTriangulation& base, std::span<const Index> nearest_vertex,
                   Index num_cells)
        : base_(base), input_(base.input()), vertices_(num_cells, [&](const auto& add) {
              for (Index v = 0; v < nearest_vertex.size(); ++v) {
                  if (nearest_vertex[v] != no_index) add(nearest_vertex[v], v);
              }
          }) {}

    //! A point of the input. The distance is infinite if there is no vertex in these cells.
    //! Cost: O(vertices in the cells).
    [[nodiscard]] ClosestPoint query(const Vec3& point, std::span<const Index> cells) const {
        ClosestPoint result;
        result.distance_sq = infinity;
        double least = result.distance_sq;
        Index nearest = no_index;
        for (const Index cell : cells) {
            for (const Index v : vertices_.of(cell)) {
                const Vec3& at = base_.surface().mesh.positions[v];
                const double distance_sq = (at - point).squaredNorm();
                if (distance_sq >= least) continue;
                least = distance_sq;
                nearest = v;
            }
        }
        if (nearest == no_index) return result;
        if (nearest >= input_.num_vertices()) {
            result = closest(base_.added_point(nearest).face.value(), point);
        } else {
            for_each_outgoing(input_, nearest, [&](Index h) {
                const ClosestPoint here = closest(Surface::face(h), point);
                if (here.distance_sq < result.distance_sq) result = here;
            });
        }
        descend(point, nearest, result);
        return result;
    }

private:
    // Most faces passed on the way to a nearer point.
    static constexpr int most_faces_passed = 1000;

    [[nodiscard]] ClosestPoint closest(Index face, const Vec3& point) const {
        return closest_point_on_triangle(corners_of(input_.mesh, face), FaceId(face), point);
    }

    // Walks from face to face while these are nearer. The faces around the vertex may be needles,
    // with the nearest point on a face beyond them.
    void descend(const Vec3& point, Index vertex, ClosestPoint& nearest) const {
        const Surface& base = base_.surface();
        const Vec3& start = base.mesh.positions[vertex];
        double reach = 0;
        for_each_outgoing(base, vertex,
                          [&](Index h) { reach = std::max(reach, base.length_of(h)); });
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

    const IntrinsicTriangulation& base_;
    const Surface& input_;
    Groups vertices_;  // Of the base, by cell.
};

}  // namespace remesh::detail
