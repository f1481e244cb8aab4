// What a half-edge does when its turn comes: it takes in the windows that wait, and sends them on.

#include <algorithm>
#include <utility>

#include "agvd/propagation/window_envelope.h"
#include "agvd/propagation/window_face.h"
#include "agvd/propagation/window_front.h"
#include "agvd/propagation/window_rays.h"

namespace agvd {
namespace {

// |v| < limit, without a root.
bool is_within(const Vec2& v, double limit) { return limit > 0 && v.squaredNorm() < limit * limit; }

}  // namespace

inline Index WindowFront::edge_record(Index half_edge, Index tail, Index head) {
    Index& slot = edge_slot_[half_edge];
    if (slot < edges_.size() && edges_[slot].half_edge == half_edge) return slot;
    corners_.prefetch(Surface::face(half_edge));
    const EdgeRecord record{half_edge, tail, head, num_arrivals_++};
    if (free_edge_ == no_index) return slot = edges_.push(record);
    slot = free_edge_;
    free_edge_ = std::exchange(edges_[slot], record).next;
    return slot;
}

void WindowFront::send(Index half_edge, Index tail, Index head, const Window& window) {
    const Index run = store_.take(1);
    store_[run].front() = window;
    wait({run, 1, window.nearest()}, half_edge, tail, head);
}

// The windows wait until the half-edge is served.
inline void WindowFront::wait(const Arrivals& arrivals, Index half_edge, Index tail, Index head) {
    if (arrivals.count == 0) {
        store_.give_back(arrivals.run);
        return;
    }
    store_.resize(arrivals.run, arrivals.count);
    const Index record = edge_record(half_edge, tail, head);
    EdgeRecord& edge = edges_[record];
    store_.next(arrivals.run) = std::exchange(edge.waiting, arrivals.run);
    queue_.push(FrontItem::half_edge(record), arrivals.nearest, edge.bucket);
    if (edge.bucket != no_index) edge.last_bucket = std::max(edge.last_bucket, edge.bucket);
}

// By the paths around the half-edge's ends, which meet at `middle`.
inline bool is_beaten(const Window& w, const WindowFace& face, double middle) {
    const double at = std::min(std::max(w.begin, middle), w.end);
    const double around = std::min(face.tail_bound + at, face.head_bound + face.length - at) -
                          w.weight + path_rounding * (w.at_begin + face.length);
    return (around <= 0) | (around * around < (at - w.x) * (at - w.x) + w.y * w.y);
}

// Cuts a window off from the last one of an envelope; it ends where it begins if nothing is left.
// False if that is not enough.
inline bool comes_in_order(std::span<Window> envelope, Window& window) {
    const std::size_t size = envelope.size();
    if (size == 0 || !(envelope[size - 1].end > window.begin)) return true;
    if (size > 1 && envelope[size - 2].end > window.begin) return false;
    return cut_where_they_change(envelope[size - 1], window);
}

// Merges the windows that wait, which come in ascending runs, into the envelope of the half-edge.
inline void WindowFront::take_in(EdgeRecord& edge, const WindowFace& face) {
    const Index waiting = std::exchange(edge.waiting, no_index);
    Index run = waiting;
    if (edge.windows != no_index || store_.next(waiting) != no_index) {
        run = gather(waiting, edge.windows);
        edge.windows = no_index;
    }
    const std::span<Window> windows = store_[run];
    const double middle = (face.head_bound + face.length - face.tail_bound) / 2;
    Index kept = 0;
    for (Index i = 0; i < windows.size(); ++i) {
        Window& w = windows[i];
        // The envelope's own are served and stay.
        if (!w.is_served && is_beaten(w, face, middle)) continue;
        if (!comes_in_order(windows.first(kept), w)) {
            edge.windows = insert_rest(run, kept, i, face);
            return;
        }
        if (w.begin == w.end) continue;
        if (kept < i) windows[kept] = w;
        ++kept;
    }
    edge.windows = settle(run, kept);
}

// Fewer where a distance's rounding is more than the face is wide: no window tells there where it
// is.
Index WindowFront::most_windows_through(const EdgeRecord& edge, const WindowFace& face) const {
    constexpr Index most_without_digits = 32;
    if (edge.num_served <= most_without_digits) return no_index;
    const double longest = std::max({face.length, face.next.length, face.previous.length});
    const double width = face.length * face.apex_y / longest;
    if (width < path_rounding * (face.tail_bound + face.length)) {
        return most_without_digits;
    }
    return queue_.order() == WindowQueue::Order::Nearest ? most_windows : no_index;
}

void WindowFront::drop_waiting(EdgeRecord& edge) {
    while (edge.waiting != no_index) {
        store_.give_back(std::exchange(edge.waiting, store_.next(edge.waiting)));
    }
    relative_error_ = infinity;
}

// Copies all windows, in order of their beginnings, into one run; where windows begin together, the
// envelope's come first and then the last that came. The others are given back.
Index WindowFront::gather(Index waiting, Index envelope) {
    order_.clear();
    if (envelope != no_index) {
        for (const Window& window : store_[envelope]) order_.push(&window);
    }
    for (Index run = waiting; run != no_index; run = store_.next(run)) {
        for (const Window& window : store_[run]) {
            Index place = order_.extend(1);
            for (; place > 0 && window.begin < order_[place - 1]->begin; --place) {
                order_[place] = order_[place - 1];
            }
            order_[place] = &window;
        }
    }
    const Index all = store_.take(order_.size());
    Window* to = store_[all].data();
    for (const Window* window : order_) *to++ = *window;
    for (Index run = waiting; run != no_index;) {
        store_.give_back(std::exchange(run, store_.next(run)));
    }
    if (envelope != no_index) store_.give_back(envelope);
    return all;
}

// Where the windows from place i on are not so simple.
Index WindowFront::insert_rest(Index run, Index kept, Index i, const WindowFace& face) {
    const std::span<Window> windows = store_[run];
    const double middle = (face.head_bound + face.length - face.tail_bound) / 2;
    envelope_.assign(windows.begin(), windows.begin() + kept);
    for (; i < windows.size(); ++i) {
        Window& w = windows[i];
        if (!w.is_served && is_beaten(w, face, middle)) continue;
        if (!comes_in_order(envelope_, w)) {
            insert_window(w, scratch_, envelope_);
        } else if (w.begin < w.end) {
            envelope_.push_back(w);
        }
    }
    const auto count = static_cast<Index>(envelope_.size());
    if (count > store_.room(run)) {
        store_.give_back(run);
        run = store_.take(count);
    }
    store_.resize(run, count);
    std::copy(envelope_.begin(), envelope_.end(), store_[run].begin());
    return settle(run, count);
}

// The envelope, of which `count` windows are left.
inline Index WindowFront::settle(Index run, Index count) {
    if (max_error_ > 0 && count > 0) count = merge_neighbours(store_[run].first(count));
    if (count == 0) {
        store_.give_back(run);
        return no_index;
    }
    store_.resize(run, count);
    return run;
}

Index WindowFront::merge_neighbours(std::span<Window> windows) {
    Index kept = 0;
    for (Index i = 1; i < windows.size(); ++i) {
        Window& last = windows[kept];
        const Window& next = windows[i];
        if (!last.is_served && !next.is_served) {
            if (const auto merged = merge_windows(last, next, max_error_)) {
                last = *merged;
                relative_error_ = std::max(relative_error_, last.error / last.nearest());
                continue;
            }
        }
        windows[++kept] = next;
    }
    return kept + 1;
}

inline void WindowFront::reach_bent(const WindowFace& face, double distance, double at,
                                    float error) {
    const VertexRecord& apex = vertices_[face.apex_record];
    const Vec2 rest(face.apex_x - at, face.apex_y);
    if (!is_within(rest, apex.upper - error - distance)) return;
    bound_vertex(face.apex_record, distance + rest.norm() + error);
}

// Reaches the apex, and decides which part of the window goes on to the right and to the left.
inline WindowFront::Division WindowFront::divide(const Window& w, EdgeRecord& edge,
                                                 const WindowFace& face) {
    const double ray = (w.x * face.apex_y - w.y * face.apex_x) / (face.apex_y - w.y);
    const double slack =
        grazing * std::min(face.length, std::min(w.at_begin, w.at_end) - w.weight) +
        frame_rounding * face.length;
    if (ray < w.begin - slack) {
        reach_bent(face, w.at_begin, w.begin, w.error);
    } else if (ray > w.end + slack) {
        reach_bent(face, w.at_end, w.end, w.error);
    } else {
        const double at_apex = reach_apex(w, ray, face);
        if (w.begin < ray && ray < w.end) return split(w, ray, at_apex, edge);
    }
    if (ray <= w.begin) return {{&w, w.begin, false}, {}};
    return {{}, {&w, w.end, false}};
}

// \return the distance of the apex.
inline double WindowFront::reach_apex(const Window& w, double ray, const WindowFace& face) {
    const Vec2 to_image(w.x - face.apex_x, w.y - face.apex_y);
    const double at_apex = w.weight + to_image.norm();
    // A merged window's end ray touches the apex on one side only, and others go past it on
    // the other side in other directions.
    const bool touches = w.error > 0 && !(w.begin < ray && ray < w.end);
    const VertexRecord& apex = vertices_[face.apex_record];
    const bool may_be_pseudo_source =
        max_error_ > 0 && surface_.can_be_pseudo_source[apex.vertex] != 0;
    if (at_apex < apex.low || may_be_pseudo_source) {
        reach_vertex(face.apex_record, at_apex, w.error,
                     touches ? no_index : Surface::previous(face.half_edge),
                     into(Vec2(-face.left_x, -face.left_y), to_image));
    } else {
        bound_vertex(face.apex_record, at_apex + w.error);
    }
    return at_apex;
}

// At the ray to the apex. One angle, one split: rays that cross the best one on its way to the apex
// lead nowhere.
inline WindowFront::Division WindowFront::split(const Window& w, double ray, double at_apex,
                                                EdgeRecord& edge) {
    Division division{{&w, ray, true}, {&w, ray, true}};
    if (at_apex < edge.apex_distance) {
        if (at_apex + w.error < edge.apex_distance) {
            edge.apex_distance = at_apex + w.error;
            edge.apex_ray = ray;
        }
    } else if (ray < edge.apex_ray) {
        division.right = {edge.apex_ray < w.end ? &w : nullptr, edge.apex_ray, false};
    } else {
        division.left = {w.begin < edge.apex_ray ? &w : nullptr, edge.apex_ray, false};
    }
    return division;
}

// The parts to one side that live.
template <auto part>
inline WindowFront::Arrivals WindowFront::pass_on(const WindowFace& face, Index most) {
    Arrivals arrivals{store_.take(most), 0, infinity};
    Window* child = store_[arrivals.run].data();
    for (const Division& division : divisions_) {
        if ((division.*part).window == nullptr) continue;
        bool lives;
        if constexpr (part == &Division::right) {
            lives = pass_right(division.right, face, *child);
        } else {
            lives = pass_left(division.left, face, *child);
        }
        if (!lives) continue;
        arrivals.nearest = std::min(arrivals.nearest, child->nearest());
        ++child;
        ++arrivals.count;
    }
    return arrivals;
}

// Takes in the windows that wait, and sends on what has not been sent on.
void WindowFront::serve_edge(Index record) {
    EdgeRecord& edge = edges_[record];
    if (edge.waiting == no_index) return;
    WindowFace face(corners_, edge.half_edge);
    face.tail_bound = vertices_[edge.tail].bound;
    face.head_bound = vertices_[edge.head].bound;
    if (edge.num_served > most_windows_through(edge, face)) {
        drop_waiting(edge);
        return;
    }
    if (may_close() && !std::exchange(edge.is_watched, true)) watch(record, queue_.current() + 3);
    take_in(edge, face);
    if (edge.windows == no_index) return;
    face.apex_record = vertex_record(face.previous.tail);

    ticker_.tick(store_[edge.windows].size());
    divisions_.clear();
    Index num_right = 0, num_left = 0;
    for (Window& window : store_[edge.windows]) {
        if (window.is_served) continue;
        window.is_served = true;
        const Division division = divide(window, edge, face);
        num_right += division.right.window == nullptr ? 0 : 1;
        num_left += division.left.window == nullptr ? 0 : 1;
        divisions_.push(division);
    }
    edge.num_served += divisions_.size();
    num_served_ += divisions_.size();
    face.apex_bound = vertices_[face.apex_record].bound;
    const Index tail = edge.tail, head = edge.head;  // Records may move.
    if (num_right > 0 && face.next.twin != no_index) {
        wait(pass_on<&Division::right>(face, num_right), face.next.twin, face.apex_record, head);
    }
    if (num_left > 0 && face.previous.twin != no_index) {
        wait(pass_on<&Division::left>(face, num_left), face.previous.twin, tail, face.apex_record);
    }
}

}  // namespace agvd
