//! \file
//! Faces that are finished while a propagation still runs.
#pragma once

#include <functional>

#include "agvd/propagation/propagate.h"

namespace agvd {

//! Where a site is the nearest.
struct VertexLabel {
    SiteId site;
    double distance = infinity;
};

//! Faces behind the front ([meng2023] Sec. 5.2). Nothing that is said of them changes any more. The
//! lists of relays are those of Propagation, but in no order.
struct RetiredFaces {
    std::vector<Index> faces;        //!< All of them.
    std::vector<Index> mixed_faces;  //!< Faces that may hold more than one label.
    std::vector<RelayRange> relay_ranges;
    std::vector<Relay> relays;
    std::function<VertexLabel(Index vertex)> label;  //!< Of their corners.
};

//! Is called now and then until each face that a site reaches has retired, once.
//! \param poller  of the propagation.
using RetirementSink = std::function<void(RetiredFaces&& retired, Poller& poller)>;

//! Propagation::site_of_point.
[[nodiscard]] std::vector<Index> sites_of_points(const PropagationOptions& options,
                                                 std::size_t num_points);

//! Propagates as propagate() does with the Steiner engine, and keeps no relays.
//! \param options  without max_error, with which no face retires before the end.
//! \throw as propagate(), and what the sink throws.
void propagate_retiring(const Surface& surface, std::span<const SurfacePoint> sites,
                        const PropagationOptions& options, const RetirementSink& sink);

}  // namespace agvd
