//! \file
//! The windows that wait at a half-edge become part of its envelope.
#pragma once

#include "agvd/propagation/window/front_state.h"

namespace agvd {

//! Merges the windows that wait, each run of them in ascending order, into the envelope of the
//! half-edge. Windows that are beaten by the bounds of the half-edge's ends are dropped.
//!
//! \param face  of the half-edge, with the bounds of its ends.
//! Cost: linear where windows come in order, as they nearly always do.
void take_in_windows(FrontState& front, EdgeRecord& edge, const WindowFace& face);

}  // namespace agvd
