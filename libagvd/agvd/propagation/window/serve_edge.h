//! \file
//! What a half-edge does when its turn comes.
#pragma once

#include "agvd/propagation/window/front_state.h"

namespace agvd {

//! Real meshes stay below 700. Around a spike that is 10^9 times as long as wide, windows circle
//! until rounding ends it: a million of them, each copied a thousand times.
inline constexpr Index most_windows = 1 << 11;

//! Takes in the windows that wait, and sends on through the face what has not been sent on. Drops
//! what waits if most_windows have been sent on in the order of distance; the run's relative error
//! is infinite then.
void serve_edge(FrontState& front, Index record);

}  // namespace agvd
