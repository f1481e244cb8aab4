// Sources: [mitchell1987] windows, [chen1990] one angle, one split, [xin2009] filters. What
// differs: windows die by bounds that all sites share, half-edges wait in buckets and are served
// with all their windows at once, and every half-edge keeps the lower envelope of its windows.

#include "agvd/propagation/window_front.h"

#include <algorithm>
#include <utility>

#include "agvd/propagation/window_rays.h"

namespace agvd {

WindowFront::WindowFront(const Surface& surface, const Corners& corners, double max_error,
                         Ticker ticker, Index small_run)
    : surface_(surface),
      corners_(corners),
      max_error_(max_error),
      ticker_(ticker),
      small_run_(small_run),
      close_factor_((1 + max_error) * (1 + max_error) * (1 + max_error) * (1 + 1e-9)),
      vertex_slot_(surface.num_vertices(), 0),
      edge_slot_(surface.twin.size(), 0),
      queue_(3 / corners.mean_length()) {}

void WindowFront::run(const SurfacePoint& site, std::span<const float> bounds, Index work_cap,
                      const KeptFaces& keeps) {
    using enum WindowQueue::Order;
    bounds_ = bounds;
    keeps_ = keeps ? &keeps : nullptr;
    if (!run_in(Buckets, site, work_cap)) (void)run_in(Nearest, site, no_index);
    keeps_ = nullptr;
}

// False if the cap was passed; what the front then holds means nothing.
bool WindowFront::run_in(WindowQueue::Order order, const SurfacePoint& site, Index work_cap) {
    vertices_.clear();
    edges_.clear();
    num_arrivals_ = 0;
    free_edge_ = no_index;
    pseudo_sources_.clear();
    free_pseudo_source_ = no_index;
    store_.clear();
    queue_.start(order);
    watched_.fill(no_index);
    num_closed_buckets_ = 0;
    num_served_ = 0;
    relative_error_ = 0;

    start(site);
    while (const auto item = next_item()) {
        const Index record = item->record();
        if (item->is_pseudo_source()) {
            const PseudoSource source = pseudo_sources_[record];
            pseudo_sources_[record].vertex = std::exchange(free_pseudo_source_, record);
            emit(source);
        } else {
            serve_edge(record);
            if (edges_[record].num_served > work_cap) return false;
        }
    }
    return true;
}

std::size_t WindowFront::bytes() const {
    return (vertex_slot_.capacity() + edge_slot_.capacity()) * sizeof(Index) + vertices_.bytes() +
           edges_.bytes() + pseudo_sources_.bytes() + store_.bytes() + queue_.bytes();
}

// --- Queue -------------------------------------------------------------------------------------

// What an item needs after its corners, and what is seldom in the cache.
[[gnu::always_inline]] inline void WindowFront::prefetch(FrontItem item) const {
    if (item.is_pseudo_source()) return;
    const EdgeRecord& edge = edges_[item.record()];
    if (edge.waiting != no_index) store_.prefetch(edge.waiting);
    const Index half_edge = edge.half_edge;
    const Corner& next = corners_[Surface::next(half_edge)];
    const Corner& previous = corners_[Surface::previous(half_edge)];
    __builtin_prefetch(&vertex_slot_[previous.tail]);
    __builtin_prefetch(&bounds_[previous.tail]);
    if (next.twin != no_index) __builtin_prefetch(&edge_slot_[next.twin]);
    if (previous.twin != no_index) __builtin_prefetch(&edge_slot_[previous.twin]);
}

std::optional<FrontItem> WindowFront::next_item() {
    while (!queue_.empty()) {
        const FrontItem item = queue_.pop([&](FrontItem ahead) { prefetch(ahead); });
        if (queue_.order() == WindowQueue::Order::Nearest) return item;
        if (num_closed_buckets_ < queue_.current()) close_edges();
        if (item.is_pseudo_source() || queue_.take(edges_[item.record()].bucket)) return item;
    }
    return std::nullopt;
}

// --- Vertices ----------------------------------------------------------------------------------

// Arrivals within each other's error may each make a vertex a pseudo-source, and send each other
// back and forth between vertices that lie closer than the error. After so many the whole fan of
// the vertex is emitted, which holds what any further one would emit.
constexpr Index max_pseudo_sources = 32;

Index WindowFront::vertex_record(Index vertex) {
    Index& slot = vertex_slot_[vertex];
    if (slot < vertices_.size() && vertices_[slot].vertex == vertex) return slot;
    const float bound = bounds_[vertex];
    return slot = vertices_.push({vertex, bound, bound});
}

// By a path that is straight where it arrives. It comes from `arrival` in the frame of the
// half-edge, or from no known direction.
void WindowFront::reach_vertex(Index record, double distance, float error, Index half_edge,
                               const Vec2& arrival) {
    bound_vertex(record, distance + error);
    VertexRecord& v = vertices_[record];
    const bool is_nearest = distance < v.low;
    if (is_nearest) v.low = distance;
    if (surface_.can_be_pseudo_source[v.vertex] == 0) return;
    if (!(distance <= v.bound * (1 + grazing))) return;
    // Of exact arrivals the nearest tells where the shadow lies; of others any may.
    if (!is_nearest && (max_error_ == 0 || distance == v.last_arrival)) return;
    v.last_arrival = distance;
    if (++v.num_pseudo_sources > max_pseudo_sources) {
        if (v.num_pseudo_sources > max_pseudo_sources + 1 && !is_nearest) return;
        half_edge = no_index;
    }
    const PseudoSource source{record, half_edge, arrival.x(), arrival.y(), distance};
    Index place = free_pseudo_source_;
    if (place == no_index) {
        place = pseudo_sources_.push(source);
    } else {
        free_pseudo_source_ = std::exchange(pseudo_sources_[place], source).vertex;
    }
    Index bucket = no_index;
    queue_.push(FrontItem::pseudo_source(place), distance, bucket);
}

// --- Half-edges --------------------------------------------------------------------------------

std::vector<Index> WindowFront::records_by_arrival() const {
    std::vector<Index> records;
    for (Index i = 0; i < edges_.size(); ++i) {
        if (edges_[i].half_edge != no_index) records.push_back(i);
    }
    std::sort(records.begin(), records.end(),
              [&](Index a, Index b) { return edges_[a].arrival < edges_[b].arrival; });
    return records;
}

// Behind the front a half-edge is closed: its windows and its record serve others. No path that is
// still to come is shorter than the distance of the current bucket; what windows say may be less by
// their errors, which close_factor_ allows for more than once, since vertices hand errors on. No
// point of the half-edge is farther than half the way around both its ends. So whatever came there
// would be beaten by the bounds of its ends, and all results are those of a run that keeps
// everything. One site on bunny holds 5 MB of windows instead of 290.
void WindowFront::watch(Index record, Index bucket) {
    const Index next = num_closed_buckets_ + 1;
    const Index place = std::clamp(bucket, next, next + most_watched_ahead - 1);
    edges_[record].next = std::exchange(watched_[place % watched_.size()], record);
}

void WindowFront::close_edges() {
    while (num_closed_buckets_ < queue_.current()) {
        ++num_closed_buckets_;
        Index& list = watched_[num_closed_buckets_ % watched_.size()];
        for (Index record = std::exchange(list, no_index); record != no_index;) {
            close_or_watch(std::exchange(record, edges_[record].next));
        }
    }
}

void WindowFront::close_or_watch(Index record) {
    EdgeRecord& edge = edges_[record];
    const double around =
        vertices_[edge.tail].bound + vertices_[edge.head].bound + corners_.length(edge.half_edge);
    const Index bucket =
        std::max(queue_.bucket_of(around / 2 * close_factor_), edge.last_bucket) + 1;
    if (bucket > num_closed_buckets_ || edge.waiting != no_index) {
        watch(record, std::min(bucket, num_closed_buckets_ + 4));
        return;
    }
    if ((*keeps_)(Surface::face(edge.half_edge))) return;
    if (edge.windows != no_index) store_.give_back(std::exchange(edge.windows, no_index));
    edge.half_edge = no_index;
    edge.next = std::exchange(free_edge_, record);
}

}  // namespace agvd
