//! \file
//! The edges at a vertex, and straight lines across the edges opposite it.
#pragma once

#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh {

//! Calls each(half-edge) for those that leave a vertex, one in each face, and then last(half-edge)
//! for the one that comes in along the boundary, if there is one.
template <typename Each, typename Last>
void for_each_outgoing(const Surface& surface, Index vertex, const Each& each, const Last& last) {
    const Index first = surface.outgoing[vertex];
    if (first == no_index) return;
    Index h = first;
    do {
        each(h);
        const Index in = Surface::previous(h);
        h = surface.twin[in];
        if (h == no_index) last(in);
    } while (h != no_index && h != first);
}

//! Calls each(other end, length) for the edges at a vertex.
template <typename Each>
void for_each_edge(const Surface& surface, Index vertex, const Each& each) {
    for_each_outgoing(
        surface, vertex, [&](Index h) { each(surface.head(h), surface.length_of(h)); },
        [&](Index in) { each(surface.tail(in), surface.length_of(in)); });
}

//! Calls each(other end, length) for the edges at a vertex and for the straight lines to the
//! vertices across the opposite edges.
template <typename Each>
void for_each_line(const Surface& surface, Index vertex, const Each& each) {
    for_each_edge(surface, vertex, each);
    const auto go_across = [&](Index h) {
        const Index opposite = Surface::next(h), twin = surface.twin[opposite];
        if (twin == no_index) return;
        // In the frame of the opposite edge, whose twin runs the other way.
        const Vec2 here = surface.apex_of(opposite), across = surface.apex_of(twin);
        const double length = surface.length_of(opposite);
        const Vec2 there(length - across.x(), -across.y());
        const double share = here.y() / (here.y() - there.y());
        const double crossing = here.x() + share * (there.x() - here.x());
        if (crossing < 0 || crossing > length) return;
        each(surface.tail(Surface::previous(twin)), (there - here).norm());
    };
    for_each_outgoing(surface, vertex, go_across, [](Index) {});
}

}  // namespace remesh
