//! \file
//! Where windows start: at the site, and at the vertices around which paths may bend.
#pragma once

#include "agvd/mesh/mesh.h"
#include "agvd/propagation/window/front_state.h"

namespace agvd {

//! Sends windows from the site into all directions.
void emit_from_site(FrontState& front, const SurfacePoint& site);

//! Sends windows into the shadow behind a saddle or boundary vertex: the directions that make an
//! angle of pi or more with the arrival on both sides.
void emit_from_pseudo_source(FrontState& front, const PseudoSource& source);

}  // namespace agvd
