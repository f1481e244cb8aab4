//! \file
//! Labels the mesh vertices.
#pragma once

#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/stage_input.h"

namespace agvd {

//! Sets EdgeLabels::mixed_index.
void list_mixed_faces(const Propagation& propagation, Index num_faces, EdgeLabels& labels);

//! Sets the labels of all vertices and their distances. A vertex all of whose faces are mixed takes
//! the nearest site over the relays of those faces, which may be nearer than the engine knows.
//! Cost: O(relays) quick steps.
void label_vertices(const StageInput& input, EdgeLabels& labels);

//! The second half of it: the vertices have what the propagation says.
//! \param is_fixed  by vertex: 1 for those that keep it.
//! \param mixed     the faces around the others.
void take_nearer_sites(const StageInput& input, std::span<const std::uint8_t> is_fixed,
                       std::span<const Index> mixed, EdgeLabels& labels);

}  // namespace agvd
