//! \file
//! Voronoi diagrams out of propagated distances.
#pragma once

#include <span>

#include "agvd/diagram/diagram.h"
#include "agvd/propagation/propagate.h"

namespace agvd {

//! Builds local Apollonius diagrams in the mixed faces and joins them ([meng2023] Sec. 4.2, 5.3).
//!
//! Cost: O(k) per mixed face and label change, k = relays of the face. Re-entrant.
//! \throw Cancelled  the progress callback returned false.
[[nodiscard]] Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                                    const Propagation& propagation,
                                    const DiagramOptions& options = {});

//! The same for a propagation that is not needed any more. Its relays are freed before the diagram
//! is drawn: they take more than a third of the memory then.
[[nodiscard]] Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                                    Propagation&& propagation, const DiagramOptions& options = {});

}  // namespace agvd
