//! \file
//! Components measured in local lengths.
#pragma once

#include "agvd/mesh/topology.h"
#include "remesh/sites/size_field.h"

namespace remesh::detail {

//! find_components with areas in squares of the local length (SizeField::area_of_face).
//! \param sizes  null: areas are in mesh units.
[[nodiscard]] std::vector<Component> sized_components(const Surface& surface,
                                                      const SizeField* sizes,
                                                      const Progress& progress = {});

//! The length of a chain of half-edges in local lengths, or in mesh units.
[[nodiscard]] double sized_length(const Surface& surface, std::span<const Index> half_edges,
                                  const SizeField* sizes);

//! boundary_length in local lengths.
[[nodiscard]] double sized_boundary_length(const Surface& surface, const Component& component,
                                           const SizeField* sizes);

}  // namespace remesh::detail
