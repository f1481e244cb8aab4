//! \file
//! The edges at a vertex.
#pragma once

#include "agvd/mesh/surface.h"

namespace remesh {

//! Calls each(other end, edge) for the edges at a vertex, the last one of a boundary vertex too.
template <typename Each>
void for_each_edge(const agvd::Surface& surface, agvd::Index vertex, const Each& each) {
    const agvd::Index first = surface.outgoing[vertex];
    if (first == agvd::no_index) return;
    agvd::Index h = first;
    do {
        each(surface.head(h), surface.edge[h]);
        const agvd::Index in = agvd::Surface::previous(h);
        h = surface.twin[in];
        if (h == agvd::no_index) each(surface.tail(in), surface.edge[in]);
    } while (h != agvd::no_index && h != first);
}

}  // namespace remesh
