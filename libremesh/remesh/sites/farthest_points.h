//! \file
//! Farthest point sampling ([eldar1997], on surfaces [moenning2003]).
#pragma once

#include <span>

#include "agvd/mesh/topology.h"
#include "remesh/sites/scatter.h"
#include "remesh/sites/size_field.h"

namespace remesh::detail {

//! Places `count` points strictly inside faces, each where the component is farthest from the
//! earlier points and from `fixed`. If there are no fixed points, the first one is random. The
//! first k points are those of a call for k points, as long as both use the same vertices (below).
//!
//! Distances follow edges and straight lines across them, and are a few per cent too long. Long
//! edges are split first, so that there are several vertices for each point. A point lies next to
//! the farthest vertex, not on it, so that ties are rare.
//! \param fixed    points of the component.
//! \param spacing  > 0, mesh units: expected distance of neighbours at the end.
//! \param sizes    spacing and distances are in local lengths; null: in mesh units.
//! \return  points at different positions; fewer than `count` only if the component is so small for
//! its coordinates that double holds no more. The same for the same seed and stream, whatever
//! num_threads.
//! Cost: O(n log n) for the first half of the points, and the same again for each doubling.
[[nodiscard]] std::vector<SurfacePoint> farthest_points(
    const Surface& surface, const Component& component, std::span<const SurfacePoint> fixed,
    Index count, double spacing, std::uint64_t seed, std::uint64_t stream, int num_threads,
    const Progress& progress = {}, const SizeField* sizes = nullptr);

}  // namespace remesh::detail
