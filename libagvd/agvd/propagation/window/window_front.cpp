// Sources: [mitchell1987] windows, [chen1990] one angle, one split, [xin2009] filters. What
// differs: windows die by bounds that all sites share, half-edges wait in buckets and are served
// with all their windows at once, and every half-edge keeps the lower envelope of its windows.

#include "agvd/propagation/window/window_front.h"

#include "agvd/propagation/window/close_edges.h"
#include "agvd/propagation/window/emit_windows.h"
#include "agvd/propagation/window/serve_edge.h"

namespace agvd {
namespace {

// Loads what an item needs after its corners, and what is seldom in the cache.
[[gnu::always_inline]] inline void prefetch(const FrontState& front, FrontItem item) {
    if (item.is_pseudo_source()) return;
    const EdgeRecord& edge = front.edges.records[item.record()];
    if (edge.waiting != no_index) front.store.prefetch(edge.waiting);
    const Corners& corners = front.input.corners;
    const Corner& next = corners[Surface::next(edge.half_edge)];
    const Corner& previous = corners[Surface::previous(edge.half_edge)];
    __builtin_prefetch(&front.vertices.place[previous.tail]);
    __builtin_prefetch(&front.input.bounds[previous.tail]);
    if (next.twin != no_index) __builtin_prefetch(&front.edges.place[next.twin]);
    if (previous.twin != no_index) __builtin_prefetch(&front.edges.place[previous.twin]);
}

// False if the item has been served from an earlier bucket. (A std::optional of the item would cost
// 5 % of the propagation: it is written in two parts and read as one, which stalls.)
bool is_due(FrontState& front, FrontItem item) {
    return item.is_pseudo_source() || front.queue.take(front.edges.records[item.record()].bucket);
}

// False if the cap was passed; what the front then holds means nothing.
bool run_in_order(FrontState& front, WindowQueue::Order order, const SurfacePoint& site,
                  Index work_cap) {
    reset(front, order);
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

void WindowFront::run(const SurfacePoint& site, std::span<const float> bounds, Index work_cap,
                      const KeptFaces& keeps) {
    using enum WindowQueue::Order;
    state_.input.bounds = bounds;
    state_.input.keeps = keeps ? &keeps : nullptr;
    if (!run_in_order(state_, Buckets, site, work_cap)) {
        (void)run_in_order(state_, Nearest, site, no_index);
    }
    state_.input.keeps = nullptr;
}

}  // namespace agvd
