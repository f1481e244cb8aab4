//! \file
//! A part of a surface around some points, for work that stays near them. Private.
#pragma once

#include <span>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"

namespace agvd {

//! Some faces as a surface of their own, with the lengths and frames of the whole.
struct Patch {
    Surface surface;
    std::vector<Index> faces;     //!< Ascending: the face of the whole that each is.
    std::vector<Index> vertices;  //!< Of each vertex that of the whole. One at which faces meet in
                                  //!< several fans is a vertex for each fan.
};

//! \param faces  ascending.
//! Cost: O(n log n), n = faces.
[[nodiscard]] Patch patch_of(const Surface& whole, std::vector<Index> faces, Ticker ticker = {});

//! All faces that hold a point no farther than `radius` from a site along the surface, ascending,
//! and some that do not: those whose corners are near enough in space.
//! Cost: O(n log n), n = those of each site.
[[nodiscard]] std::vector<Index> faces_within(const Surface& surface,
                                              std::span<const SurfacePoint> sites, double radius,
                                              Ticker ticker = {});

}  // namespace agvd
