//! \file
//! Multi-source geodesic distance propagation: the first stage of the AGVD.
#pragma once

#include <span>

#include "agvd/propagation/propagation_options.h"
#include "agvd/propagation/relays.h"
#include "agvd/propagation/surface_layout.h"

namespace agvd {

//! Propagates distances from all sites at once.
//!
//! \param sites  t surface points; several may share a face or even a position (the lower index
//!               then owns it).
//! \throw InvalidOption    an option is out of range, or the engine cannot do what it asks.
//! \throw InvalidSites     a site names a face that does not exist or has coordinates off the face.
//! \throw ConstraintUnmet  the Steiner engine cannot meet max_error.
//! \throw Cancelled        the progress callback returned false.
//! Re-entrant.
[[nodiscard]] Propagation propagate(const Surface& surface, std::span<const SurfacePoint> sites,
                                    const PropagationOptions& options = {});

//! The same for a surface whose layout exists already. The Steiner engine does not use it.
[[nodiscard]] Propagation propagate(const Surface& surface, const SurfaceLayout& layout,
                                    std::span<const SurfacePoint> sites,
                                    const PropagationOptions& options = {});
//! The same for a layout that is not needed any more. Its parts, which are larger than the surface,
//! are freed as soon as propagation has used them.
[[nodiscard]] Propagation propagate(const Surface& surface, SurfaceLayout&& layout,
                                    std::span<const SurfacePoint> sites,
                                    const PropagationOptions& options = {});

}  // namespace agvd
