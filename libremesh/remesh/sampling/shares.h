//! \file
//! How many sites belong on each part of a surface.
#pragma once

#include <span>
#include <vector>

#include "remesh/topology/components.h"

namespace remesh::detail {

//! Distance of neighbours in a mesh of equilateral triangles with this number of vertices, those on
//! the boundary included.
[[nodiscard]] double spacing_of(double num_vertices, double area, double boundary_length);

//! Vertices of such a mesh that are not on the boundary; negative where it is narrower than that.
[[nodiscard]] double inner_sites(double area, double boundary_length, double spacing);

//! Whole numbers with the sum `total`, in proportion to the weights (>= 0): the largest remainders
//! are rounded up. Cost: O(n log n).
[[nodiscard]] std::vector<agvd::Index> apportion(std::span<const double> weights,
                                                 agvd::Index total);

//! What the topology of each component needs (minimum_samples), summed up.
[[nodiscard]] std::uint64_t needed_samples(const std::vector<Component>& components);

//! What each component's topology needs, and the rest by the vertices that a mesh of equilateral
//! triangles would have there.
//!
//! \param boundary_length  of each component, as far as sites lie on it.
//! \pre num_samples is at least needed_samples.
[[nodiscard]] std::vector<agvd::Index> share_out(const std::vector<Component>& components,
                                                 std::span<const double> boundary_length,
                                                 agvd::Index num_samples);

}  // namespace remesh::detail
