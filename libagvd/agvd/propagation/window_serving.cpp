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

void WindowFront::send(Index half_edge, Index tail, Index head, std::span<const Window> windows) {
    if (windows.empty()) return;
    const Index record = edge_record(half_edge, tail, head);
    EdgeRecord& edge = edges_[record];
    const Index run = store_.take(static_cast<Index>(windows.size()));
    store_.next(run) = edge.waiting;
    edge.waiting = run;
    double nearest = infinity;
    Window* to = store_[run].data();
    for (const Window& window : windows) {
        nearest = std::min(nearest, window.nearest());
        *to++ = window;
    }
    queue_.push(edge_item(record), nearest, edge.bucket);
    if (edge.bucket != no_index) edge.last_bucket = std::max(edge.last_bucket, edge.bucket);
}

// Merges the windows that wait, which come in ascending runs, into the envelope of the half-edge.
inline void WindowFront::take_in(EdgeRecord& edge, const WindowFace& face) {
    const auto is_beaten = [&](const Window& w) {
        const double at =
            meeting_point(face.tail_bound, face.head_bound, face.length, w.begin, w.end);
        const double around = std::min(face.tail_bound + at, face.head_bound + face.length - at) -
                              w.weight + path_rounding * (w.at_begin + face.length);
        return (around <= 0) | (around * around < (at - w.x) * (at - w.x) + w.y * w.y);
    };
    const Index only = edge.waiting;
    edge.waiting = no_index;
    const bool is_alone = edge.windows == no_index && store_.next(only) == no_index;
    if (is_alone && store_[only].size() == 1) {  // Nine of ten at 2000 sites: it stays where it is.
        if (is_beaten(store_[only].front())) {
            store_.give_back(only);
        } else {
            edge.windows = only;
        }
        return;
    }
    order_.clear();
    if (edge.windows != no_index) {
        for (const Window& window : store_[edge.windows]) order_.push(&window);
    }
    for (Index run = only; run != no_index; run = store_.next(run)) {
        for (const Window& window : store_[run]) {
            if (is_beaten(window)) continue;
            Index place = order_.extend(1);
            for (; place > 0 && window.begin < order_[place - 1]->begin; --place) {
                order_[place] = order_[place - 1];
            }
            order_[place] = &window;
        }
    }
    envelope_.clear();
    for (const Window* window : order_) insert_window(*window, scratch_, envelope_);
    if (max_error_ > 0) merge_neighbours();
    for (Index run = only; run != no_index;) store_.give_back(std::exchange(run, store_.next(run)));
    if (edge.windows != no_index) store_.give_back(edge.windows);
    edge.windows = no_index;
    if (envelope_.empty()) return;
    edge.windows = store_.take(static_cast<Index>(envelope_.size()));
    std::copy(envelope_.begin(), envelope_.end(), store_[edge.windows].begin());
}

void WindowFront::merge_neighbours() {
    std::size_t kept = 0;
    for (std::size_t i = 1; i < envelope_.size(); ++i) {
        Window& last = envelope_[kept];
        const Window& next = envelope_[i];
        if (!last.is_served && !next.is_served) {
            if (const auto merged = merge_windows(last, next, max_error_)) {
                last = *merged;
                relative_error_ = std::max(relative_error_, last.error / last.nearest());
                continue;
            }
        }
        envelope_[++kept] = next;
    }
    if (!envelope_.empty()) envelope_.resize(kept + 1);
}

void WindowFront::reach_bent(const WindowFace& face, double distance, double at, float error) {
    const VertexRecord& apex = vertices_[face.apex_record];
    const Vec2 rest(face.apex_x - at, face.apex_y);
    if (!is_within(rest, apex.upper - error - distance)) return;
    bound_vertex(face.apex_record, distance + rest.norm() + error);
}

// Reaches the apex, and decides which part of the window goes on to the right and to the left.
inline WindowFront::Division WindowFront::divide(Window& w, EdgeRecord& edge, const WindowFace& face) {
    w.is_served = true;
    ++num_served_;
    ++edge.num_served;
    const double ray = (w.x * face.apex_y - w.y * face.apex_x) / (face.apex_y - w.y);
    const double slack =
        grazing * std::min(face.length, std::min(w.at_begin, w.at_end) - w.weight) +
        frame_rounding * face.length;
    if (ray < w.begin - slack) {
        reach_bent(face, w.at_begin, w.begin, w.error);
    } else if (ray > w.end + slack) {
        reach_bent(face, w.at_end, w.end, w.error);
    } else {
        const Vec2 to_image(w.x - face.apex_x, w.y - face.apex_y);
        const double at_apex = w.weight + to_image.norm();
        // A merged window's end ray touches the apex on one side only, and others go past it on
        // the other side in other directions.
        const bool touches = w.error > 0 && !(w.begin < ray && ray < w.end);
        const VertexRecord& apex = vertices_[face.apex_record];
        const bool may_turn = max_error_ > 0 && surface_.can_turn[apex.vertex] != 0;
        if (at_apex < apex.low || may_turn) {
            reach_vertex(face.apex_record, at_apex, w.error,
                         touches ? no_index : Surface::previous(face.half_edge),
                         into(Vec2(-face.left_x, -face.left_y), to_image));
        } else {
            bound_vertex(face.apex_record, at_apex + w.error);
        }
        if (w.begin < ray && ray < w.end) {
            Division division{{&w, ray, true}, {&w, ray, true}};
            // One angle, one split: rays that cross the best one on its way to the apex lead
            // nowhere.
            if (at_apex < edge.apex_distance) {
                if (at_apex + w.error < edge.apex_distance) {
                    edge.apex_distance = at_apex + w.error;
                    edge.apex_ray = ray;
                }
            } else if (ray < edge.apex_ray) {
                division.right = {&w, edge.apex_ray, false};
                if (!(edge.apex_ray < w.end)) division.right.window = nullptr;
            } else {
                division.left = {&w, edge.apex_ray, false};
                if (!(w.begin < edge.apex_ray)) division.left.window = nullptr;
            }
            return division;
        }
    }
    if (ray <= w.begin) return {{&w, w.begin, false}, {}};
    return {{}, {&w, w.end, false}};
}

// Takes in the windows that wait, and sends on what has not been sent on.
void WindowFront::serve_edge(Index record) {
    EdgeRecord& edge = edges_[record];
    if (edge.waiting == no_index) return;
    if (may_close() && !std::exchange(edge.is_watched, true)) watch(record, queue_.current() + 3);
    WindowFace face(corners_, edge.half_edge);
    face.tail_bound = vertices_[edge.tail].bound;
    face.head_bound = vertices_[edge.head].bound;
    take_in(edge, face);
    if (edge.windows == no_index) return;
    face.apex_record = vertex_record(face.previous.tail);

    divisions_.clear();
    for (Window& window : store_[edge.windows]) {
        if (!window.is_served) divisions_.push(divide(window, edge, face));
    }
    face.apex_bound = vertices_[face.apex_record].bound;
    children_.clear();
    children_.extend(2 * divisions_.size());
    Index num_right = 0;
    if (face.next.twin != no_index) {
        for (const auto& [right, left] : divisions_) {
            if (right.window == nullptr) continue;
            num_right += pass_right(right, face, children_[num_right]) ? 1 : 0;
        }
    }
    Index count = num_right;
    if (face.previous.twin != no_index) {
        for (const auto& [right, left] : divisions_) {
            if (left.window == nullptr) continue;
            count += pass_left(left, face, children_[count]) ? 1 : 0;
        }
    }
    const Index tail = edge.tail;
    const Index head = edge.head;
    const std::span<const Window> children{&children_[0], count};
    send(face.next.twin, face.apex_record, head, children.first(num_right));
    send(face.previous.twin, tail, face.apex_record, children.subspan(num_right));
}

}  // namespace agvd
