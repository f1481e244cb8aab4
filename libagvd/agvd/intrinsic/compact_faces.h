//! \file
//! Closes the gaps that removed vertices leave. Private to intrinsic.
#pragma once

#include "agvd/intrinsic/face_history.h"
#include "agvd/mesh/surface.h"

namespace agvd::detail {

//! Closes gaps: the last faces and edges take the numbers of those that are gone. Charts become
//! invalid.
void compact_faces(Surface& surface, FaceHistory& history);

}  // namespace agvd::detail
