//! \file
//! Faces with sites inside are cut into triangles at them.
#pragma once

#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/relay_groups.h"
#include "agvd/propagation/site_placement.h"

namespace agvd {

//! Adds inner points, cuts, cut triangles and the rows of the cuts to `labels`. Sites that lie on
//! edges reach the boundary by themselves; a site that owns nothing at its own place is left out.
//! \param mixed  positions in mixed_faces, ascending: uncut so far.
//! Parallel. Cost: the relays near it, a site inside a listed face, and sorting the face's relays.
void cut_faces(const Surface& surface, const Propagation& propagation,
               const SitePlacement& placement, const RelayGroups& groups,
               std::span<const Index> mixed, int num_threads, Poller& poller, EdgeLabels& labels);

//! Takes out what belongs to a face, if it is cut, but for its entry in cut_faces.
void release_cut(const CutFace& cut, Index num_vertices, EdgeLabels& labels);

}  // namespace agvd
