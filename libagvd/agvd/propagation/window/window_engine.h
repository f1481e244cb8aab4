//! \file
//! The window engine: exact or error-bounded propagation.
#pragma once

#include <memory>

#include "agvd/propagation/corners.h"
#include "agvd/propagation/distance_bounds.h"
#include "agvd/propagation/propagation_options.h"
#include "agvd/propagation/relays.h"

namespace agvd {

//! If more windows of one site are served through one half-edge, the site is propagated again in
//! the order of distance. Real meshes stay below 700.
inline constexpr Index default_work_cap = 1 << 11;

//! propagate() with Engine::Window, its options checked.
//!
//! \param corners  Corners(surface); given back before the relays are sorted by face.
//! \param bounds   distance_bounds of the sites.
//! Every site is propagated on its own, as far as the bounds allow. Threads run different sites.
//! The result of a site depends on nothing but the site and the bounds. Near the borders of the
//! bounds windows are kept as relays. Where a border lies elsewhere, the sites concerned run once
//! more.
//! Cost: about O(n sqrt(n / t)) time for exact distances, O(n) for error-bounded ones, O(n) space.
[[nodiscard]] Propagation propagate_windows(const Surface& surface,
                                            std::shared_ptr<const Corners> corners,
                                            DistanceBounds bounds,
                                            std::span<const SurfacePoint> sites,
                                            const PropagationOptions& options,
                                            Index work_cap = default_work_cap);
//! The same, but the corners and the bounds are made here.
[[nodiscard]] Propagation propagate_windows(const Surface& surface,
                                            std::span<const SurfacePoint> sites,
                                            const PropagationOptions& options);

}  // namespace agvd
