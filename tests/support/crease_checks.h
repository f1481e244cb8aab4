//! \file
//! How well a mesh reproduces the creases, corners and faces of its surface.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "agvd/mesh/mesh.h"

namespace crease_checks {

using Segment = std::pair<agvd::Vec3, agvd::Vec3>;

//! Edges between faces whose normals differ by more than `degrees`.
[[nodiscard]] std::vector<Segment> creases(const agvd::TriangleMesh& mesh, double degrees);

//! Vertices where three of these or more meet.
[[nodiscard]] std::vector<agvd::Vec3> junctions(const agvd::TriangleMesh& mesh, double degrees);

//! Share of the length of creases above 40 degrees of `input` that lies within `tolerance` of a
//! crease above 25 degrees of `output`, measured at eight points of each edge. 1 if there are none.
[[nodiscard]] double coverage(const agvd::TriangleMesh& input, const agvd::TriangleMesh& output,
                              double tolerance);

//! The farthest that any of the points lies from the nearest vertex.
[[nodiscard]] double farthest_from_vertices(std::span<const agvd::Vec3> points,
                                            const agvd::TriangleMesh& mesh);

//! The farthest that a point of `mesh` lies from `surface`, of 28 in each triangle: 0 if every
//! triangle lies in one of its planar faces.
[[nodiscard]] double farthest_from_surface(const agvd::TriangleMesh& mesh,
                                           const agvd::TriangleMesh& surface);

}  // namespace crease_checks
