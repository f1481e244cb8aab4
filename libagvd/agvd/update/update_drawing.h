//! \file
//! Draws a diagram most of which has been drawn before.
#pragma once

#include "agvd/diagram/diagram.h"
#include "agvd/update/kept_diagram.h"

namespace agvd {

//! Replaces all of `diagram` but nearest_site and nearest_distance. The points of edges that have
//! been drawn before are copied.
//! \param diagram  as the last call for these parts left it, or any before the first.
//! \throw Cancelled  neither `kept` nor `diagram` is of use any more.
//! Cost: O(edges + points of new ones + boundary), and copying the points of the others.
void update_drawing(const Surface& surface, Ticker ticker, KeptDiagram& kept, Diagram& diagram);

}  // namespace agvd
