//! \file
//! Walks around a vertex.
#pragma once

#include "agvd/mesh/surface.h"

namespace agvd {

//! Calls each(half_edge) for the half-edges from a vertex, one for each face around it,
//! counter-clockwise; none if the vertex has no face.
template <typename Each>
void for_each_outgoing(const Surface& surface, Index vertex, const Each& each) {
    const Index first = surface.outgoing[vertex];
    for (Index h = first; h != no_index;) {
        each(h);
        h = surface.twin[Surface::previous(h)];
        if (h == first) break;
    }
}

}  // namespace agvd
