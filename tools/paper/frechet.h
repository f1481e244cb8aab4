//! \file
//! Distances between curves that are given by points in space ([meng2023] Sec. 6.2).
//!
//! A coupling pairs the points of two curves, both walked forward without leaving a point out; its
//! length is that of its longest link (Eq. 7). The discrete Fréchet distance is the least length of
//! a coupling. It exceeds that of the curves between the points by at most the larger step.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/core/types.h"

namespace agvd {

//! Discrete Fréchet distance of two open curves, first point paired with first and last with last.
//! \param p, q  not empty.
//! Cost: O(#p #q) time, O(#q) memory.
[[nodiscard]] double frechet_distance(std::span<const Vec3> p, std::span<const Vec3> q);

//! Discrete Fréchet distance of two closed curves, which do not repeat their first points, walked
//! in their given directions from the best pair of starting points. At most 1e-7 of it too large;
//! exact where it equals the Hausdorff distance.
//! \param p, q  not empty.
//! Cost: some 25 passes over the pairs that lie nearer than the result, O(log #q) more for each
//! point of p; O(#p #q) a pass at worst. O(#q) memory.
//! \param ticker  polls in between.
[[nodiscard]] double closed_frechet_distance(std::span<const Vec3> p, std::span<const Vec3> q,
                                             Ticker ticker = {});

//! The larger of how far any point of p is from the nearest of q, and any of q from p: a lower
//! bound of both distances above.
//! \param p, q  not empty, in the order of a curve: the search skips points by the steps between
//!              them.
//! Cost: O(#p #q) at worst, O((#p + #q) log) for curves that run side by side. No memory.
[[nodiscard]] double hausdorff_distance(std::span<const Vec3> p, std::span<const Vec3> q,
                                        Ticker ticker = {});

//! Length of a closed polyline.
[[nodiscard]] double closed_length(std::span<const Vec3> loop);

//! `count` points at equal steps of length along a closed polyline, in its direction.
//! \param loop   not empty.
//! \param start  where the first of them lies, as length along the loop from its first point.
[[nodiscard]] std::vector<Vec3> resampled(std::span<const Vec3> loop, Index count,
                                          double start = 0);

//! Length along a closed polyline, from its first point, to its point nearest to `query`.
[[nodiscard]] double nearest_on_loop(std::span<const Vec3> loop, const Vec3& query);

}  // namespace agvd
