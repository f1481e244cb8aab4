//! \file
//! The number of sites for each part of a surface.
#pragma once

#include <span>
#include <vector>

#include "agvd/mesh/topology.h"
#include "remesh/names.h"

namespace remesh::detail {

//! The distance of neighbours in a mesh of equilateral triangles with this number of vertices,
//! which include those on the boundary.
[[nodiscard]] double spacing_of(double num_vertices, double area, double boundary_length);

//! The number of inner vertices of such a mesh; negative if the surface is too narrow for the
//! spacing.
[[nodiscard]] double inner_sites(double area, double boundary_length, double spacing);

//! Whole numbers with the sum `total`, in proportion to the weights (>= 0): the largest remainders
//! are rounded up. Cost: O(n log n).
[[nodiscard]] std::vector<Index> apportion(std::span<const double> weights, Index total);

//! The number of sites with which a component can be recognised: some times minimum_samples, 16 for
//! a sphere and 28 for a torus.
[[nodiscard]] Index recognisable_samples(const Component& component);

//! Gives parts that have less than they want as much, from what others have beyond that. At most a
//! quarter of all is given away; if that is not enough, every part gets the same share of what it
//! lacks.
//!
//! \param wanted  by part.
//! \param quota   by part; edited in place, the sum stays.
void lift_small(std::span<const Index> wanted, std::vector<Index>& quota);

//! The sum of minimum_samples over the components.
[[nodiscard]] std::uint64_t needed_samples(const std::vector<Component>& components);

//! The sites of each component: what its topology needs, and a share of the rest in proportion to
//! the vertices that a mesh of equilateral triangles would have there. Of several components small
//! ones get up to recognisable_samples. Fewer samples than needed_samples are all shared in that
//! proportion, so that some components may get none.
//!
//! \param boundary_length  #components, mesh units: of the boundary on which sites lie.
[[nodiscard]] std::vector<Index> share_out(const std::vector<Component>& components,
                                           std::span<const double> boundary_length,
                                           Index num_samples);

}  // namespace remesh::detail
