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

//! Calls each(half_edge, other) for the edges at a vertex, counter-clockwise: a half-edge of the
//! edge, and the vertex at its other end.
template <typename Each>
void for_each_edge_at(const Surface& surface, Index vertex, const Each& each) {
    for_each_outgoing(surface, vertex, [&](Index h) {
        each(h, surface.head(h));
        const Index last = Surface::previous(h);  // No half-edge leaves along it.
        if (surface.twin[last] == no_index) each(last, surface.tail(last));
    });
}

//! The end of an edge that is not `vertex`.
[[nodiscard]] inline Index other_end(const Surface& surface, Index edge, Index vertex) {
    const Index h = surface.edge_half[edge];
    return surface.tail(h) == vertex ? surface.head(h) : surface.tail(h);
}

}  // namespace agvd
