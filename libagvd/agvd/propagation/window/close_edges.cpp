// A half-edge may be closed if all that could still come there would be beaten by the bounds of its
// ends. No path that is still to come is shorter than the distance of the current bucket. What
// windows say may be less by their errors; close_factor allows for more than one error, since
// vertices hand errors on. No point of the half-edge is farther than half the way around both its
// ends. So all results are those of a run that keeps everything.

#include "agvd/propagation/window/close_edges.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace agvd {
namespace {

double close_factor(double max_error) {
    return (1 + max_error) * (1 + max_error) * (1 + max_error) * (1 + 1e-9);
}

void close_or_watch(FrontState& front, Index record) {
    EdgeRecord& edge = front.edges.records[record];
    assert(edge.half_edge != no_index);
    const auto& vertices = front.vertices.records;
    const double around = vertices[edge.tail].bound + vertices[edge.head].bound +
                          front.input.corners.length(edge.half_edge);
    const double farthest = around / 2 * close_factor(front.input.max_error);
    const Index bucket = std::max(front.queue.bucket_of(farthest), edge.last_bucket) + 1;
    const Index now = front.watched.num_closed;
    if (bucket > now || edge.waiting != no_index) {
        watch(front, record, std::min(bucket, now + 4));
        return;
    }
    if ((*front.input.keeps)(Surface::face(edge.half_edge))) return;
    if (edge.windows != no_index) {
        front.store.give_back(std::exchange(edge.windows, no_index));
    }
    front.edges.give_back(record);
}

}  // namespace

void watch(FrontState& front, Index record, Index bucket) {
    WatchList& watched = front.watched;
    const Index next = watched.num_closed + 1;
    const Index place = std::clamp(bucket, next, next + WatchList::most_ahead - 1);
    Index& list = watched.first[place % watched.first.size()];
    front.edges.records[record].next = std::exchange(list, record);
}

void close_edges(FrontState& front) {
    WatchList& watched = front.watched;
    while (watched.num_closed < front.queue.current()) {
        ++watched.num_closed;
        Index& list = watched.first[watched.num_closed % watched.first.size()];
        for (Index record = std::exchange(list, no_index); record != no_index;) {
            close_or_watch(front, std::exchange(record, front.edges.records[record].next));
        }
    }
}

}  // namespace agvd
