//! \file
//! The window engine: exact or error-bounded propagation.
#pragma once

#include <memory>

#include "agvd/propagation/corners.h"
#include "agvd/propagation/distance_bounds.h"
#include "agvd/propagation/propagation_options.h"
#include "agvd/propagation/relays.h"

namespace agvd {

//! Windows served through one half-edge, from one site, before its site is propagated again in the
//! order of distance. Real meshes stay below 700.
inline constexpr Index default_work_cap = 1 << 11;

//! In which order sites run, and their relays stand in a face: that of their faces, neighbours on
//! most meshes, so that caches stay warm.
[[nodiscard]] inline bool runs_before(FaceId face, Index site, FaceId other_face, Index other) {
    return face < other_face || (face == other_face && site < other);
}

//! propagate() with Engine::Window, its options checked.
//!
//! \param corners  Corners(surface); given back before the relays are sorted by face.
//! \param bounds   distance_bounds of the sites.
//! Sites are propagated one by one, each as far as the bounds allow, and side by side: what a site
//! gives depends on nothing but itself and the bounds. Windows are kept as relays near the borders
//! that the bounds show; where that misses a border the sites concerned run once more.
//! Cost: about O(n sqrt(n / t)) time for exact distances, O(n) for error-bounded ones, O(n) space.
[[nodiscard]] Propagation propagate_windows(const Surface& surface,
                                            std::shared_ptr<const Corners> corners,
                                            DistanceBounds bounds,
                                            std::span<const SurfacePoint> sites,
                                            const PropagationOptions& options,
                                            Index work_cap = default_work_cap);
//! The same; it makes the corners and the bounds.
[[nodiscard]] Propagation propagate_windows(const Surface& surface,
                                            std::span<const SurfacePoint> sites,
                                            const PropagationOptions& options);

}  // namespace agvd
