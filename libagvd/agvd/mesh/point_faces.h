//! \file
//! Points on edges and vertices: which faces hold them, and whether they lie on the boundary.
#pragma once

#include <optional>

#include "agvd/mesh/one_ring.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace agvd {

//! The vertex a point lies on, if it does: up to 1e-12 of the shorter edge of its face there.
//! Nearer than that, rounding hides from which side the point sees the faces around the vertex.
[[nodiscard]] std::optional<Index> vertex_of(const Surface& surface, const SurfacePoint& point);

//! The same as the half-edge of the point's face that leaves that vertex: which corner it is, where
//! the face has the vertex at several.
[[nodiscard]] std::optional<Index> corner_of(const Surface& surface, const SurfacePoint& point);

//! The half-edge of the point's face in whose interior the point lies, if it does: up to 1e-12 of
//! the face's height. Nearer than that, windows through the edge would hold nothing but rounding.
[[nodiscard]] std::optional<Index> half_edge_of(const SurfacePoint& point);

//! The same point of an edge's interior, seen from the face across `half_edge` (which must exist).
[[nodiscard]] SurfacePoint across_edge(const Surface& surface, const SurfacePoint& point,
                                       Index half_edge);

//! Calls visit(SurfacePoint) for all that name this point: one for each corner around a vertex, one
//! for each side of an edge, itself inside a face. What is not exactly on an edge (coordinate 0)
//! is inside. A face comes more than once where it has the vertex at several corners, or is glued
//! to itself along the edge. At a vertex in the order of the one-ring, else itself first.
template <typename Visit>
void for_each_view(const Surface& surface, const SurfacePoint& point, const Visit& visit) {
    const auto& b = point.barycentric;
    const auto num_zeros = (b[0] == 0 ? 1 : 0) + (b[1] == 0 ? 1 : 0) + (b[2] == 0 ? 1 : 0);
    const Index face = point.face.value();
    if (num_zeros == 2) {
        const Index k = b[0] != 0 ? 0 : b[1] != 0 ? 1 : 2;
        for_each_outgoing(surface, surface.tail(3 * face + k), [&](Index h) {
            SurfacePoint view{FaceId(Surface::face(h)), {0, 0, 0}};
            view.barycentric[h % 3] = b[k];
            visit(view);
        });
        return;
    }
    visit(point);
    if (num_zeros != 1) return;
    const Index k = b[2] == 0 ? 0 : b[0] == 0 ? 1 : 2;
    const Index h = 3 * face + k;
    if (surface.twin[h] != no_index) visit(across_edge(surface, point, h));
}

//! The same point as a point of `face`; none if it does not lie in that face. The first of several.
[[nodiscard]] std::optional<SurfacePoint> seen_from(const Surface& surface,
                                                    const SurfacePoint& point, Index face);

//! Faces that hold both of two different points, at most two. There are no more unless the surface
//! is a Delta-complex (see IntrinsicTriangulation). Cost: O(faces around a and b).
struct CommonFaces {
    Index first = no_index;   //!< no_index: none.
    Index second = no_index;  //!< Where both lie on one edge; no_index otherwise.
};
[[nodiscard]] CommonFaces common_faces(const Surface& surface, const SurfacePoint& a,
                                       const SurfacePoint& b);

//! On a boundary edge, or on one of its ends.
[[nodiscard]] bool is_on_boundary(const Surface& surface, const SurfacePoint& point);

//! The vertex as a point of one of its faces. It must have one.
[[nodiscard]] SurfacePoint point_at(const Surface& surface, Index vertex);

//! Position of a surface point in the frame of one of its face's half-edges.
[[nodiscard]] Vec2 position_in_frame(const Surface& surface, const SurfacePoint& point,
                                     Index half_edge);

}  // namespace agvd
