//! \file
//! Labels the mesh vertices and edges.
#pragma once

#include "agvd/core/poller.h"
#include "agvd/diagram/cell_tally.h"
#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/relay_groups.h"
#include "agvd/diagram/touched_parts.h"

namespace agvd {

void list_mixed_faces(const Surface& surface, const Propagation& propagation, EdgeLabels& labels);

//! A vertex all of whose faces are listed takes the nearest site over the relays of those faces,
//! which may be nearer than the engine's graph knows. Touched vertices only.
//! \param mixed  positions in mixed_faces, ascending: all touched faces.
void label_vertices(const Surface& surface, const Propagation& propagation,
                    const TouchedParts& touched, std::span<const Index> mixed, int num_threads,
                    Poller& poller, EdgeLabels& labels);

//! Replaces the rows of touched edges and says which are others now. An edge all of whose faces are
//! listed has the envelope of the relays of both sides and of its ends.
//! \param mixed  positions in mixed_faces, ascending: all faces of such edges.
//! Cost: O(relays) a face, O(relays) and a few square roots a crossing.
void label_edges(const Surface& surface, const Propagation& propagation, const RelayGroups& groups,
                 std::span<const Index> mixed, int num_threads, Poller& poller,
                 TouchedParts& touched, EdgeLabels& labels, CellTally& tally);

}  // namespace agvd
