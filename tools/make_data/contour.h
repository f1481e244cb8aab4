//! \file
//! Meshes the surface where a function changes sign, by marching through the tetrahedra of a
//! body-centred cubic lattice whose points are first pulled onto the surface where they lie close
//! to it ([labelle2007], the surface part): the triangles come out well shaped.
#pragma once

#include <functional>

#include "agvd/mesh/mesh.h"

namespace make_data {

//! Negative inside, positive outside; about a distance near the surface.
using Field = std::function<double(const agvd::Vec3&)>;
//! Where a lattice point lies in space: one-to-one; a conformal map keeps the triangles well
//! shaped.
using Placement = std::function<agvd::Vec3(const agvd::Vec3&)>;

struct ContourOptions {
    Placement place;
    agvd::Vec3 inside = agvd::Vec3::Zero();  //!< In lattice space, within the surface.
    double spacing = 0.1;  //!< Edge of the lattice's cubes, in lattice space, > 0.
    double jitter = 0;     //!< Lattice points move by up to this share of the spacing.
    int smoothing = 2;     //!< Rounds of moving vertices along the surface to even out the faces.
};

//! The connected piece of the closed surface that is met first from `inside` along one direction.
//! Only +, -, *, / and square roots are used, so a field that does the same gives the same bytes on
//! every machine. Cost: O(faces) field evaluations.
[[nodiscard]] agvd::TriangleMesh contour(const Field& field, const ContourOptions& options);

}  // namespace make_data
