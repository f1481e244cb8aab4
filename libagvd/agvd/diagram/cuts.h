//! \file
//! Faces with sites inside are cut into triangles at them.
#pragma once

#include "agvd/diagram/edge_labels.h"
#include "agvd/propagation/site_placement.h"

namespace agvd {

//! Appends inner points, cuts, cut triangles and the rows of the cuts to `labels`. Sites that lie
//! on edges reach the boundary by themselves; a site that owns nothing at its own place is left
//! out.
//! Parallel. Cost: the relays near it, a site inside a listed face, and sorting the face's relays.
void cut_faces(const Surface& surface, const Propagation& propagation,
               const SitePlacement& placement, const RelayGroups& groups, int num_threads,
               EdgeLabels& labels);

}  // namespace agvd
