//! \file
//! A sequence of faces from one surface point to another. It fixes on which side a path passes
//! vertices. Private to the paths.
#pragma once

#include "agvd/core/progress.h"
#include "agvd/paths/geodesic_path.h"

namespace agvd {

//! A path leaves its face across half-edge i into the face of half-edge i + 1. All paths through
//! one strip pass every vertex on the same side; a face may occur twice.
struct FaceStrip {
    SurfacePoint source;           //!< Seen from the face of the first half-edge.
    SurfacePoint target;           //!< Seen from the face across the last one; without any,
                                   //!< from the face of the source.
    std::vector<Index> crossed{};  //!< Half-edges in their order; none is on the boundary.
};

//! Appends a crossing of a half-edge, or undoes the last one if it is the reverse.
void cross(const Surface& surface, Index half_edge, std::vector<Index>& crossed);

//! The strip along a path; parameters and errors of straighten_path. Snaps its points.
[[nodiscard]] FaceStrip strip_along(const Surface& surface, std::span<const SurfacePoint> points,
                                    std::span<const FaceId> faces);

//! Drops crossings of edges on which the source or the target lies.
void trim(const Surface& surface, FaceStrip& strip);

//! The locally shortest path that straighten_path finds from a strip.
[[nodiscard]] GeodesicPath straighten(const Surface& surface, FaceStrip strip, Ticker ticker = {});

}  // namespace agvd
