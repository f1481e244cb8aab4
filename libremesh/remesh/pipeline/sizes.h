//! \file
//! The target lengths of a run.
#pragma once

#include "remesh/pipeline/curves.h"
#include "remesh/sizing/size_field.h"

namespace remesh::detail {

struct RunSizes {
    std::unique_ptr<const SizeField> field;  //!< Null: all edges are equally long.
    agvd::Index num_samples = 0;             //!< To place; as given, or as the lengths give it.
};

//! \param found    creases and junctions: curvature does not count across them.
//! \param spacing  mesh units: of the sites in the mean.
//! \param most_lengths  #V of the cleaned mesh: no target is longer; or empty.
//! Cost: that of a base, and a few sweeps over the edges.
[[nodiscard]] RunSizes find_sizes(const CleanedInput& cleaned, const FoundCurves& found,
                                  double spacing, std::span<const double> most_lengths,
                                  const StageContext& context);

//! Compares a mesh with the target lengths.
//!
//! \param sites  #V: places of the vertices on the surface.
//! \param sizes  null: all targets are equal.
//! Cost: O(n log n).
[[nodiscard]] SizingResult measure_edges(const agvd::MeshView& mesh,
                                         std::span<const agvd::SurfacePoint> sites,
                                         agvd::Index num_samples, const SizeField* sizes);

}  // namespace remesh::detail
