//! \file
//! Points on edges and vertices: which faces hold them, and whether they lie on the boundary.
#pragma once

#include <optional>

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace agvd {

//! The vertex a point lies on, if it does: up to 1e-12 of the shorter edge of its face there.
//! Nearer than that, rounding hides from which side the point sees the faces around the vertex.
[[nodiscard]] std::optional<Index> vertex_of(const Surface& surface, const SurfacePoint& point);

//! The half-edge of the point's face in whose interior the point lies, if it does: up to 1e-12 of
//! the face's height. Nearer than that, windows through the edge would hold nothing but rounding.
[[nodiscard]] std::optional<Index> half_edge_of(const SurfacePoint& point);

//! The same point of an edge's interior, seen from the face across `half_edge` (which must exist).
[[nodiscard]] SurfacePoint across_edge(const Surface& surface, const SurfacePoint& point,
                                       Index half_edge);

//! The same point as a point of `face`; none if it does not lie in that face.
[[nodiscard]] std::optional<SurfacePoint> seen_from(const Surface& surface,
                                                    const SurfacePoint& point, Index face);

//! The faces that hold both of two different points: at most two. Cost: O(faces around a).
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

}  // namespace agvd
