//! \file
//! Closes the gaps that removed vertices leave. Private to intrinsic.
#pragma once

#include "agvd/intrinsic/face_history.h"
#include "agvd/mesh/surface.h"

namespace agvd::detail {

//! Closes gaps: the last faces and edges get the numbers of removed ones. Charts become invalid.
void compact_faces(Surface& surface, FaceHistory& history);

}  // namespace agvd::detail
