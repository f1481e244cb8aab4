//! \file
//! A part of a surface with chosen points as vertices. Private to the metrics.
#pragma once

#include <span>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"

namespace agvd {

struct Patch {
    TriangleMesh mesh;
    std::vector<Index> vertex;  //!< Of each point; no_index: its face is not in the patch.
    bool is_whole = false;      //!< The patch has every face of the component.
};

//! The faces that lie within `radius` of `center` in space and hang together with its face, cut up
//! so that the points are vertices. Vertices at which only the patch falls apart are doubled.
//!
//! A point nearer to an edge or another point than 1e-6 of its face is moved onto it, or that far
//! away from it. Cost: O(#faces taken + #points k), k = points in one face.
[[nodiscard]] Patch cut_patch(const Surface& surface, const SurfacePoint& center, double radius,
                              std::span<const SurfacePoint> points, Ticker ticker = {});

}  // namespace agvd
