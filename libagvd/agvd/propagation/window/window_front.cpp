// Sources: [mitchell1987] windows, [chen1990] one angle, one split, [xin2009] filters. What
// differs: windows die by bounds that all sites share, half-edges wait in buckets and are served
// with all their windows at once, and every half-edge keeps the lower envelope of its windows.
//
// A half-edge may be closed if all that could still come there would be beaten by the bounds of its
// ends. No path that is still to come is shorter than the distance of the current bucket. What
// windows say may be less by their errors; close_factor allows for more than one error, since
// vertices hand errors on. No point of the half-edge is farther than half the way around both its
// ends. So all results are those of a run that keeps everything.

#include "agvd/propagation/window/window_front.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace agvd {
namespace {

double close_factor(double max_error) {
    return (1 + max_error) * (1 + max_error) * (1 + max_error) * (1 + 1e-9);
}

void close_or_watch(WindowFront& front, Index record) {
    EdgeRecord& edge = front.edges.records[record];
    assert(edge.half_edge != no_index);
    const auto& vertices = front.vertices.records;
    const double around = vertices[edge.tail].bound + vertices[edge.head].bound +
                          front.corners.length(edge.half_edge);
    const double farthest = around / 2 * close_factor(front.max_error);
    const Index bucket = std::max(front.queue.bucket_of(farthest), edge.last_bucket) + 1;
    const Index now = front.watched.num_closed;
    if (bucket > now || edge.waiting != no_index) {
        watch(front, record, std::min(bucket, now + 4));
        return;
    }
    if ((*front.keeps)(Surface::face(edge.half_edge))) return;
    if (edge.windows != no_index) {
        front.store.give_back(std::exchange(edge.windows, no_index));
    }
    front.edges.give_back(record);
}

}  // namespace

void close_edges(WindowFront& front) {
    WatchList& watched = front.watched;
    while (watched.num_closed < front.queue.current()) {
        ++watched.num_closed;
        Index& list = watched.first[watched.num_closed % watched.first.size()];
        for (Index record = std::exchange(list, no_index); record != no_index;) {
            close_or_watch(front, std::exchange(record, front.edges.records[record].next));
        }
    }
}

namespace {

// Loads what an item needs after its corners, and what is seldom in the cache.
[[gnu::always_inline]] inline void prefetch(const WindowFront& front, FrontItem item) {
    if (item.is_pseudo_source()) return;
    const EdgeRecord& edge = front.edges.records[item.record()];
    if (edge.waiting != no_index) front.store.prefetch(edge.waiting);
    const Corners& corners = front.corners;
    const Corner& next = corners[Surface::next(edge.half_edge)];
    const Corner& previous = corners[Surface::previous(edge.half_edge)];
    __builtin_prefetch(&front.vertices.place[previous.tail]);
    __builtin_prefetch(&front.bounds[previous.tail]);
    if (next.twin != no_index) __builtin_prefetch(&front.edges.place[next.twin]);
    if (previous.twin != no_index) __builtin_prefetch(&front.edges.place[previous.twin]);
}

// False if the item has been served from an earlier bucket. (A std::optional of the item would cost
// 5 % of the propagation: it is written in two parts and read as one, which stalls.)
bool is_due(WindowFront& front, FrontItem item) {
    return item.is_pseudo_source() || front.queue.take(front.edges.records[item.record()].bucket);
}

// False if the cap was passed; what the front then holds means nothing.
bool run_in_order(WindowFront& front, WindowQueue::Order order, const SurfacePoint& site,
                  Index work_cap) {
    front.reset(order);
    emit_from_site(front, site);
    while (!front.queue.empty()) {
        const FrontItem item = front.queue.pop([&](FrontItem next) { prefetch(front, next); });
        close_edges(front);
        if (!is_due(front, item)) continue;
        const Index record = item.record();
        if (item.is_pseudo_source()) {
            emit_from_pseudo_source(front, front.pseudo_sources.take(record));
        } else {
            serve_edge(front, record);
            if (front.edges.records[record].num_served > work_cap) return false;
        }
    }
    return true;
}

}  // namespace

void run_front(WindowFront& front, const SurfacePoint& site, std::span<const float> bounds,
               Index work_cap, const KeptFaces& keeps) {
    using enum WindowQueue::Order;
    front.bounds = bounds;
    front.keeps = keeps ? &keeps : nullptr;
    if (!run_in_order(front, Buckets, site, work_cap)) {
        (void)run_in_order(front, Nearest, site, no_index);
    }
    front.keeps = nullptr;
}

}  // namespace agvd
