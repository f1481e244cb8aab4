//! \file
//! A walk around a vertex of triangles whose twins are known. Private to the library.
#pragma once

#include <span>

#include "agvd/core/half_edge.h"

namespace agvd {

//! Whether an edge joins the tail of a half-edge to a vertex, in the fan of triangles that holds
//! the half-edge.
//!
//! \param twin  #H; no_index where the fan ends.
//! Cost: O(triangles of the fan).
[[nodiscard]] inline bool are_joined(std::span<const Triangle> triangles,
                                     std::span<const Index> twin, Index half_edge, Index vertex) {
    const auto holds = [&](Index h) {  // The triangle of h, which leaves the tail.
        const Index head = next_half_edge(h), apex = previous_half_edge(h);
        return triangles[h / 3][head % 3] == vertex || triangles[h / 3][apex % 3] == vertex;
    };
    Index h = half_edge;
    do {
        if (holds(h)) return true;
        h = twin[previous_half_edge(h)];
    } while (h != no_index && h != half_edge);
    if (h == half_edge) return false;
    for (h = twin[half_edge]; h != no_index; h = twin[h]) {
        h = next_half_edge(h);
        if (holds(h)) return true;
    }
    return false;
}

}  // namespace agvd
