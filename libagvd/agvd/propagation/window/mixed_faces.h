//! \file
//! Sorts the windows of all sites by face: these are the relays of the faces that may hold more
//! than one label.
#pragma once

#include "agvd/core/progress.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/window/relay_logs.h"

namespace agvd {

//! Writes the mixed faces and their relays into `result`, whose vertices are final. A face is mixed
//! if its windows, its corners and the sites inside it belong to more than one site.
//!
//! \param logs  the windows of every face that may be mixed; consumed. Relays of a face keep their
//! order.
//! Cost: O(#F + relays).
void write_mixed_faces(const Surface& surface, const SitePlacement& placement, RelayLogs logs,
                       int num_threads, Poller& poller, Propagation& result);

}  // namespace agvd
