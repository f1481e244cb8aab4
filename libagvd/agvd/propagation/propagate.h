//! \file
//! Multi-source geodesic distance propagation: the first stage of the AGVD.
#pragma once

#include <span>

#include "agvd/core/progress.h"
#include "agvd/propagation/relays.h"

namespace agvd {

//! `{}` gives the paper's defaults.
struct PropagationOptions {
    int steiner_points = 8;  //!< m: Steiner points on each edge, in [0, 1000].
    double lambda = 1;       //!< Triangles are retired every lambda * #F pops, > 0. Memory only.
    Progress progress = {};
};

//! Propagates distances from all sites at once ([meng2023] Algorithm 1).
//!
//! \param sites  t surface points; several may share a face or even a position (the lower index
//!               then owns it).
//! \throw InvalidOption  an option is out of range.
//! \throw InvalidInput   a site names a face that does not exist or has coordinates off the face.
//! \throw Cancelled      the progress callback returned false.
//! Cost: O(m n log(m n)) time, O(m n) space, n = #F. Re-entrant. The same bytes for every lambda.
[[nodiscard]] Propagation propagate(const Surface& surface, std::span<const SurfacePoint> sites,
                                    const PropagationOptions& options = {});

}  // namespace agvd
