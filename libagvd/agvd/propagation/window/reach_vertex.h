//! \file
//! Paths that arrive at vertices: they lower bounds and may make pseudo-sources.
#pragma once

#include "agvd/propagation/window/front_state.h"

namespace agvd {

//! The end of a path at a vertex. The path is straight there.
struct Arrival {
    double distance;  //!< From below: a real path of at most `error` more arrives.
    float error;
    Index half_edge;  //!< Leaves the vertex; no_index: the direction is not known.
    Vec2 direction;   //!< Towards where the path comes from, in the frame of the half-edge.
};

//! \return the record of a vertex, which is made if there is none.
[[nodiscard]] inline Index vertex_record(FrontState& front, Index vertex) {
    const Index record = front.vertices.find(vertex);
    if (record != no_index) return record;
    const float bound = front.input.bounds[vertex];
    return front.vertices.add({vertex, bound, bound});
}

//! Takes in a path that arrives at a vertex. Makes a pseudo-source if the path may bend there.
void reach_vertex(FrontState& front, Index record, const Arrival& arrival);

}  // namespace agvd
