//! \file
//! The two engines, which propagate() calls with checked options. To them every point is a site of
//! its own, and every shape one behind the points: of PropagationOptions::points they read `start`
//! only, which has an entry for each of them or none, and of a shape not its site.
#pragma once

#include <cmath>

#include "agvd/propagation/retirement.h"

namespace agvd {

//! \throw InvalidSites, InvalidOption  as propagate(), of what it says of sites.
void check_generators(const Surface& surface, std::span<const SurfacePoint> sites,
                      const SitePoints& roles, const std::vector<SiteShape>& shapes);

//! If more windows of one site are served through one half-edge, the site is propagated again in
//! the order of distance. Real meshes stay below 700.
inline constexpr Index default_work_cap = 1 << 11;

//! The window engine: every site on its own, as far as upper bounds of the distances allow. Cost:
//! about O(n sqrt(n / t)) time for exact distances, O(n) for error-bounded ones, O(n) space.
//! \param caps  #V, >= 0, or none: only paths to points p with length(p) <= caps[v] + |v p| for the
//!              vertices v of their faces are looked for, and no vertex gets a longer distance.
[[nodiscard]] Propagation propagate_windows(const Surface& surface, SurfaceLayout layout,
                                            std::span<const SurfacePoint> sites,
                                            const PropagationOptions& options,
                                            Index work_cap = default_work_cap,
                                            std::span<const float> caps = {});

//! The float at or above a value.
[[nodiscard]] inline float rounded_up(double value) {
    const auto rounded = static_cast<float>(value);
    if (rounded >= value) return rounded;
    return std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

//! The paper's engine: multi-source propagation over Steiner points.
//! \throw ConstraintUnmet  for max_error 1000 points on an edge do not suffice, or will foreseeably
//!                         not suffice.
//! Cost with max_error: the window engine once, and one propagation a round; there are at most 20.
[[nodiscard]] Propagation propagate_steiner(const Surface& surface,
                                            std::span<const SurfacePoint> sites,
                                            const PropagationOptions& options);

//! The same without max_error, face by face.
void retire_steiner(const Surface& surface, std::span<const SurfacePoint> sites,
                    const PropagationOptions& options, const RetirementSink& sink);

}  // namespace agvd
