//! \file
//! Parts by formula: planar and round faces that meet in sharp creases.
#pragma once

#include <cstdint>
#include <functional>

#include "agvd/mesh/mesh.h"

namespace parts {

//! Box with corners (0, 0, 0) and `size`; n quads along each edge.
[[nodiscard]] agvd::TriangleMesh box(const agvd::Vec3& size, agvd::Index n);
//! The same without the face z = 0: creases along eight edges.
[[nodiscard]] agvd::TriangleMesh open_box(const agvd::Vec3& size, agvd::Index n);
//! The regular hexagon of radius 1 around z, extruded to height 1; n quads along each side.
//! Creases: 18 chains, 18 units.
[[nodiscard]] agvd::TriangleMesh hexagonal_prism(agvd::Index n);
//! The unit squares (0, 0), (1, 0) and (0, 1) of a plane, extruded to height 1; n quads along each
//! square's side. Creases: 18 chains, 22 units.
[[nodiscard]] agvd::TriangleMesh extruded_l(agvd::Index n);
//! Cylinder around z of radius 1 from z = 0 to 2 with flat caps. Creases: two circles.
[[nodiscard]] agvd::TriangleMesh capped_cylinder(agvd::Index sides, agvd::Index rings);
//! A cone of radius and height 1 on an open disc of radius 3. Crease: the circle of radius 1.
[[nodiscard]] agvd::TriangleMesh cone_on_plate(agvd::Index sides, agvd::Index rings);
//! Half a cylinder of radius 1 around x laid through one of radius 2 around y, open below.
//! Creases: two curves of n edges from boundary to boundary, of 60 degrees in the middle and 90 at
//! the ends. n even.
[[nodiscard]] agvd::TriangleMesh crossing_vaults(agvd::Index n);
//! A plate |x| <= 4, |y| <= half_width, n x m quads, m even, folded along y = 0 by an angle that
//! may differ from x to x.
//! \param degrees  of the fold, at x.
[[nodiscard]] agvd::TriangleMesh folded_plate(agvd::Index n, agvd::Index m, double half_width,
                                              const std::function<double(double x)>& degrees);
//! Cut open along x = `at` for |y| < reach, where it has an edge: vertices inside are copied.
[[nodiscard]] agvd::TriangleMesh with_slit(agvd::TriangleMesh mesh, double at, double reach);
//! A plate 4 x 4 with a rib of width and height `width` across its middle; n quads along a side.
//! Creases: four lines of length 4 and, at the open ends, none.
[[nodiscard]] agvd::TriangleMesh ribbed_plate(double width, agvd::Index n);

//! Splits edges next to an end and faces next to a side: new faces are `aspect` as high as they are
//! long, and no point of the surface moves.
//! \param share  of the faces, 0 to 1.
[[nodiscard]] agvd::TriangleMesh with_needles(const agvd::TriangleMesh& mesh, double aspect,
                                              double share, std::uint64_t seed);
//! Turned at random.
[[nodiscard]] agvd::TriangleMesh turned(agvd::TriangleMesh mesh, std::uint64_t seed);

}  // namespace parts
