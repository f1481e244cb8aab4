//! \file
//! Faces with sites inside are cut into triangles at them.
#pragma once

#include "agvd/diagram/diagram_parts.h"
#include "agvd/diagram/stage_input.h"

namespace agvd {

//! Adds inner points, cuts, cut triangles and the rows of the cuts to the labels. Sites that lie on
//! edges reach the boundary by themselves; a site that owns nothing at its own place is left out.
//! \param mixed   faces that are not cut so far.
//! Parallel. Cost: the relays near it, a site inside a mixed face, and sorting the face's relays.
void cut_faces(const StageInput& input, std::span<const Index> mixed, DiagramParts& parts);

}  // namespace agvd
