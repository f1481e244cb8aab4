#include "agvd/propagation/window/serve_edge.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "agvd/propagation/window/close_edges.h"
#include "agvd/propagation/window/divide_window.h"
#include "agvd/propagation/window/reach_vertex.h"
#include "agvd/propagation/window/send_windows.h"
#include "agvd/propagation/window/take_in_windows.h"

namespace agvd {
namespace {

// Fewer where a distance's rounding is more than the face is wide: no window tells there where it
// is.
Index most_windows_through(const FrontState& front, const EdgeRecord& edge,
                           const WindowFace& face) {
    constexpr Index most_without_digits = 32;
    if (edge.num_served <= most_without_digits) return no_index;
    const double longest = std::max({face.length, face.next.length, face.previous.length});
    const double width = face.length * face.apex_y / longest;
    if (width < path_rounding * (face.tail_bound + face.length)) {
        return most_without_digits;
    }
    return front.queue.order() == WindowQueue::Order::Nearest ? most_windows : no_index;
}

void drop_waiting(FrontState& front, EdgeRecord& edge) {
    while (edge.waiting != no_index) {
        front.store.give_back(std::exchange(edge.waiting, front.store.next(edge.waiting)));
    }
    front.relative_error = infinity;
}

// How many windows have a part on either side.
struct PartCounts {
    Index right = 0, left = 0;
};

// Divides the windows of the half-edge that have not been sent on.
PartCounts divide_windows(FrontState& front, EdgeRecord& edge, const WindowFace& face) {
    RunArray<Division>& divisions = front.scratch.divisions;
    divisions.clear();
    PartCounts counts;
    for (Window& window : front.store[edge.windows]) {
        if (window.is_served) continue;
        window.is_served = true;
        const Division division = divide(front, window, edge, face);
        counts.right += division.right.window == nullptr ? 0 : 1;
        counts.left += division.left.window == nullptr ? 0 : 1;
        divisions.push(division);
    }
    edge.num_served += divisions.size();
    front.num_served += divisions.size();
    return counts;
}

// The parts to one side that live. `most`: as many as there are parts.
template <auto part>
SentWindows pass_on(FrontState& front, const WindowFace& face, Index most) {
    SentWindows sent{front.store.take(most), 0, infinity};
    Window* child = front.store[sent.run].data();
    for (const Division& division : front.scratch.divisions) {
        if ((division.*part).window == nullptr) continue;
        bool lives;
        if constexpr (part == &Division::right) {
            lives = pass_right(division.right, face, *child);
        } else {
            lives = pass_left(division.left, face, *child);
        }
        if (!lives) continue;
        sent.nearest = std::min(sent.nearest, child->nearest());
        ++child;
        ++sent.count;
    }
    assert(sent.count <= most);
    return sent;
}

}  // namespace

void serve_edge(FrontState& front, Index record) {
    EdgeRecord& edge = front.edges.records[record];
    if (edge.waiting == no_index) return;
    WindowFace face(front.input.corners, edge.half_edge);
    face.tail_bound = front.vertices.records[edge.tail].bound;
    face.head_bound = front.vertices.records[edge.head].bound;
    if (edge.num_served > most_windows_through(front, edge, face)) {
        drop_waiting(front, edge);
        return;
    }
    if (may_close(front) && !std::exchange(edge.is_watched, true)) {
        watch(front, record, front.queue.current() + 3);
    }
    take_in_windows(front, edge, face);
    if (edge.windows == no_index) return;
    face.apex_record = vertex_record(front, face.previous.tail);

    front.ticker.tick(front.store[edge.windows].size());
    const auto [num_right, num_left] = divide_windows(front, edge, face);
    face.apex_bound = front.vertices.records[face.apex_record].bound;
    const Index tail = edge.tail, head = edge.head;  // Records may move.
    if (num_right > 0 && face.next.twin != no_index) {
        send(front, {face.next.twin, face.apex_record, head},
             pass_on<&Division::right>(front, face, num_right));
    }
    if (num_left > 0 && face.previous.twin != no_index) {
        send(front, {face.previous.twin, tail, face.apex_record},
             pass_on<&Division::left>(front, face, num_left));
    }
}

}  // namespace agvd
