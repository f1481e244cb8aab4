//! \file
//! What the stages of a diagram read.
#pragma once

#include <numeric>
#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/propagation/relays.h"
#include "agvd/propagation/site_placement.h"

namespace agvd {

//! Keeps references. Stages name mixed faces by their positions in Propagation::mixed_faces, in
//! ascending order.
struct StageInput {
    const Surface& surface;
    std::span<const SurfacePoint> sites;
    const SitePlacement& placement;  //!< Of the sites.
    const Propagation& propagation;
    double chord_tolerance;  //!< As in DiagramOptions.
    int num_threads;         //!< As in DiagramOptions.
    Poller& poller;
};

//! The positions of all mixed faces.
[[nodiscard]] inline std::vector<Index> all_mixed(const Propagation& propagation) {
    std::vector<Index> all(propagation.mixed_faces.size());
    std::iota(all.begin(), all.end(), Index{0});
    return all;
}

//! The faces at these positions.
[[nodiscard]] inline std::vector<Index> faces_at(const Propagation& propagation,
                                                 std::span<const Index> mixed) {
    std::vector<Index> faces;
    faces.reserve(mixed.size());
    for (const Index i : mixed) faces.push_back(propagation.mixed_faces[i]);
    return faces;
}

}  // namespace agvd
