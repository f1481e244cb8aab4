//! \file
//! The number of sites for each part of a surface.
#pragma once

#include <span>
#include <vector>

#include "agvd/mesh/topology.h"
#include "remesh/sites/size_field.h"

namespace remesh {

//! No simplicial surface of this genus and number of boundary loops has fewer vertices: 4 for the
//! sphere, 7 for the torus, 3 for the disc. Closed ones can be built with it ([jungerman1980]).
//! \param genus, boundary_loops  >= 0, of one connected component.
[[nodiscard]] Index minimum_samples(int genus, int boundary_loops);

//! The same for all components together. Cost: O(#components).
[[nodiscard]] Index minimum_samples(const Topology& topology);

namespace detail {

//! Replaces Component::area_up_to.
void set_areas(std::vector<Component>& components, std::span<const double> area_of_face);

//! find_components with areas in squares of the local length (SizeField::area_of_face).
//! \param sizes  null: areas are in mesh units, here and below.
[[nodiscard]] std::vector<Component> sized_components(const Surface& surface,
                                                      const SizeField* sizes,
                                                      const Progress& progress = {});

//! The length of a component's edges with a single face, in local lengths.
[[nodiscard]] double sized_boundary_length(const Surface& surface, const Component& component,
                                           const SizeField* sizes);

//! The distance of neighbours in a closed mesh of equilateral triangles with so many vertices.
[[nodiscard]] double spacing_of(double num_vertices, double area);

//! The number of inner vertices of a mesh of equilateral triangles; negative if the surface is too
//! narrow for the spacing.
[[nodiscard]] double inner_sites(double area, double boundary_length, double spacing);

//! Whole numbers with the sum `total`, in proportion to the weights (>= 0): the largest remainders
//! are rounded up. Cost: O(n log n).
[[nodiscard]] std::vector<Index> apportion(std::span<const double> weights, Index total);

//! The sum of minimum_samples over the components.
[[nodiscard]] std::uint64_t needed_samples(const std::vector<Component>& components);

//! The sites of each component: what its topology needs, and a share of the rest by area. Small
//! ones of several get up to four times what they need. Fewer than needed_samples are all shared in
//! that proportion: some components may get none.
[[nodiscard]] std::vector<Index> share_out(const std::vector<Component>& components,
                                           Index num_samples);

//! The inner sites of each component, by how many it lacks at this spacing. Small closed ones,
//! which have no sites on curves, get more as in share_out.
[[nodiscard]] std::vector<Index> share_out_inner(const Surface& surface,
                                                 const std::vector<Component>& components,
                                                 Index count, double spacing,
                                                 const SizeField* sizes);

}  // namespace detail
}  // namespace remesh
