//! \file
//! The edges at a vertex, and straight lines across the edges opposite it.
#pragma once

#include "agvd/mesh/surface.h"

namespace remesh {

//! Calls each(other end, length) for the edges at a vertex, the last one of a boundary vertex too,
//! and for the straight lines to the vertices across the opposite edges. Paths of these are a few
//! per cent longer than geodesics.
template <typename Each>
void for_each_line(const agvd::Surface& surface, agvd::Index vertex, const Each& each) {
    using agvd::Index;
    using agvd::Surface;
    const Index first = surface.outgoing[vertex];
    if (first == agvd::no_index) return;
    Index h = first;
    do {
        each(surface.head(h), surface.length_of(h));
        const Index opposite = Surface::next(h), twin = surface.twin[opposite];
        if (twin != agvd::no_index) {
            // In the frame of the opposite edge, whose twin runs the other way.
            const agvd::Vec2 here = surface.apex_of(opposite), across = surface.apex_of(twin);
            const double length = surface.length_of(opposite);
            const agvd::Vec2 there(length - across.x(), -across.y());
            const double share = here.y() / (here.y() - there.y());
            const double crossing = here.x() + share * (there.x() - here.x());
            if (crossing >= 0 && crossing <= length) {
                each(surface.tail(Surface::previous(twin)), (there - here).norm());
            }
        }
        const Index in = Surface::previous(h);
        h = surface.twin[in];
        if (h == agvd::no_index) each(surface.tail(in), surface.length_of(in));
    } while (h != agvd::no_index && h != first);
}

}  // namespace remesh
