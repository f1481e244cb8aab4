//! \file
//! Windows on their way to a half-edge, where they wait until it is served.
#pragma once

#include <algorithm>
#include <cassert>
#include <utility>

#include "agvd/propagation/window/front_state.h"

namespace agvd {

//! Windows in the order of their beginnings.
struct SentWindows {
    Index run, count;
    double nearest;  //!< The least of their distances.
};

//! Adds windows to those that wait at a half-edge, and queues the half-edge.
inline void send(FrontState& front, const HalfEdgeEnds& to, const SentWindows& windows) {
    if (windows.count == 0) {
        front.store.give_back(windows.run);
        return;
    }
    front.store.resize(windows.run, windows.count);
    Index record = front.edges.find(to.half_edge);
    if (record == no_index) {
        front.input.corners.prefetch(Surface::face(to.half_edge));
        record = front.edges.add(to);
    }
    EdgeRecord& edge = front.edges.records[record];
    assert(edge.tail == to.tail && edge.head == to.head);
    front.store.next(windows.run) = std::exchange(edge.waiting, windows.run);
    front.queue.push(FrontItem::half_edge(record), windows.nearest, edge.bucket);
    if (edge.bucket != no_index) edge.last_bucket = std::max(edge.last_bucket, edge.bucket);
}

//! The same for one window.
inline void send(FrontState& front, const HalfEdgeEnds& to, const Window& window) {
    assert(window.begin < window.end && window.y <= 0);
    const Index run = front.store.take(1);
    front.store[run].front() = window;
    send(front, to, SentWindows{run, 1, window.nearest()});
}

}  // namespace agvd
