#include "agvd/propagation/window/front_state.h"

namespace agvd {

FrontState make_front_state(const FrontInput& input, Ticker ticker) {
    constexpr double buckets_per_edge = 3;
    FrontState front{input, WindowQueue(buckets_per_edge / input.corners.mean_length()), ticker};
    front.vertices.place.assign(input.surface.num_vertices(), 0);
    front.edges.place.assign(input.surface.twin.size(), 0);
    reset(front, WindowQueue::Order::Buckets);
    return front;
}

void reset(FrontState& front, WindowQueue::Order order) {
    front.vertices.records.clear();
    front.edges.records.clear();
    front.edges.num_arrivals = 0;
    front.edges.first_free = no_index;
    front.pseudo_sources.records.clear();
    front.pseudo_sources.first_free = no_index;
    front.store.clear();
    front.queue.start(order);
    front.watched.first.fill(no_index);
    front.watched.num_closed = 0;
    front.num_served = 0;
    front.relative_error = 0;
}

std::size_t bytes(const FrontState& front) {
    return (front.vertices.place.capacity() + front.edges.place.capacity()) * sizeof(Index) +
           front.vertices.records.bytes() + front.edges.records.bytes() +
           front.pseudo_sources.records.bytes() + front.store.bytes() + front.queue.bytes();
}

}  // namespace agvd
