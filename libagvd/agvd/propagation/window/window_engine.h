//! \file
//! The window engine: exact or error-bounded propagation.
#pragma once

#include "agvd/propagation/propagate.h"

namespace agvd {

//! If more windows of one site are served through one half-edge, the site is propagated again in
//! the order of distance. Real meshes stay below 700.
inline constexpr Index default_work_cap = 1 << 11;

//! propagate() with Engine::Window, its options checked.
//!
//! Every site is propagated on its own, as far as upper bounds of the distances allow. Threads run
//! different sites. The result of a site depends on nothing but the site and the bounds. Near the
//! borders of the bounds windows are kept as relays. Where a border lies elsewhere, the sites
//! concerned run once more.
//! Cost: about O(n sqrt(n / t)) time for exact distances, O(n) for error-bounded ones, O(n) space.
[[nodiscard]] Propagation propagate_windows(const Surface& surface, SurfaceLayout layout,
                                            std::span<const SurfacePoint> sites,
                                            const PropagationOptions& options,
                                            Index work_cap = default_work_cap);
//! The same, but the layout is made here.
[[nodiscard]] Propagation propagate_windows(const Surface& surface,
                                            std::span<const SurfacePoint> sites,
                                            const PropagationOptions& options);

}  // namespace agvd
