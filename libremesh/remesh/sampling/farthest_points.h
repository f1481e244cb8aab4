//! \file
//! Farthest points, one after the other ([eldar1997], on surfaces [moenning2003]).
#pragma once

#include <span>

#include "remesh/sampling/scatter.h"
#include "remesh/topology/components.h"

namespace remesh::detail {

//! `count` points, each where the component is farthest from the points before it and from `fixed`;
//! without any of these, a random one comes first. So the first k of them are what asking for k
//! gives, as far as the vertices below stay the same. Strictly inside faces.
//!
//! Distances run along the edges of the component and straight across them, a few per cent too
//! long; long edges are split for it until there are several vertices for each point. A point lies
//! next to the farthest of these vertices, not on it, so that few points tie.
//! \param fixed    points of the component.
//! \param spacing  > 0, mesh units: expected distance of neighbours in the end.
//! \return  no two at one position; fewer than `count` only where the component is so small for its
//!          coordinates that double tells no more apart. The same for the same seed and stream,
//!          whatever num_threads.
//! Cost: O(n log n) for the first half of the points, as much again each time they double.
[[nodiscard]] std::vector<agvd::SurfacePoint> farthest_points(
    const agvd::Surface& surface, const Component& component,
    std::span<const agvd::SurfacePoint> fixed, agvd::Index count, double spacing,
    std::uint64_t seed, std::uint64_t stream, int num_threads, const agvd::Progress& progress = {});

}  // namespace remesh::detail
