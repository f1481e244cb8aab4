//! \file
//! The target lengths of a run.
#pragma once

#include "remesh/pipeline/curves.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/sites/size_field.h"

namespace remesh::detail {

struct RunSizes {
    std::unique_ptr<const SizeField> field;  //!< Null: all edges are equally long.
    Index num_samples = 0;                   //!< To place; as given, or as the lengths give it.
};

//! No target is longer than the locked edges beside it.
//! \param found    creases and junctions: curvature does not count across them.
//! \param spacing  mesh units: of the sites in the mean.
//! \param narrow_points   on the cleaned surface: where edges have to be shorter (narrow_lengths).
//! \param short_points    likewise, by these lengths.
//! Cost: that of a base, and a few sweeps over the edges.
[[nodiscard]] RunSizes find_sizes(const CleanedInput& cleaned, const FoundCurves& found,
                                  double spacing, std::span<const SurfacePoint> narrow_points,
                                  std::span<const SizedPoint> short_points,
                                  const StageContext& context);

//! Compares a mesh with the target lengths.
//! \param sites  #V: the vertices on the surface.
//! \param sizes  null: all targets are equal.
//! Cost: O(n log n).
[[nodiscard]] SizingResult measure_edges(const MeshView& mesh, std::span<const SurfacePoint> sites,
                                         Index num_samples, const SizeField* sizes);

}  // namespace remesh::detail
