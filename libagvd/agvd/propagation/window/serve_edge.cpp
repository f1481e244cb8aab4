// Windows that wait at a half-edge become part of its lower envelope, unless they lose to the
// bounds of its ends; then they are divided at the apex of the face behind it, and go on. They
// mostly come in order, and one cut between neighbours is enough; others are inserted one by one.
#include "agvd/propagation/window/window_front.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "agvd/propagation/window/window_envelope.h"

namespace agvd {
namespace {

// Where the paths around the half-edge's ends meet.
double meeting_point(const WindowFace& face) {
    return (face.head_bound + face.length - face.tail_bound) / 2;
}

// By the paths around the half-edge's ends, which meet at `middle`.
bool is_beaten(const Window& w, const WindowFace& face, double middle) {
    const double at = std::min(std::max(w.begin, middle), w.end);
    const double around = std::min(face.tail_bound + at, face.head_bound + face.length - at) -
                          w.weight + path_rounding * (w.at_begin + face.length);
    return (around <= 0) | (around * around < (at - w.x) * (at - w.x) + w.y * w.y);
}

// Cuts a window off from the last one of an envelope; it ends where it begins if nothing is left.
// False if that is not enough.
bool comes_in_order(std::span<Window> envelope, Window& window) {
    const std::size_t size = envelope.size();
    if (size == 0 || !(envelope[size - 1].end > window.begin)) return true;
    if (size > 1 && envelope[size - 2].end > window.begin) return false;
    return cut_where_they_change(envelope[size - 1], window);
}

// Copies all windows, in order of their beginnings, into one run. Where windows begin together, the
// envelope's come first and then the last that came. The other runs are given back.
Index gather(WindowFront& front, Index waiting, Index envelope) {
    WindowStore& store = front.store;
    RunArray<const Window*>& order = front.scratch.order;
    order.clear();
    if (envelope != no_index) {
        for (const Window& window : store[envelope]) order.push(&window);
    }
    for (Index run = waiting; run != no_index; run = store.next(run)) {
        for (const Window& window : store[run]) {
            Index slot = order.extend(1);
            for (; slot > 0 && window.begin < order[slot - 1]->begin; --slot) {
                order[slot] = order[slot - 1];
            }
            order[slot] = &window;
        }
    }
    const Index all = store.take(order.size());
    Window* to = store[all].data();
    for (const Window* window : order) *to++ = *window;
    for (Index run = waiting; run != no_index;) {
        store.give_back(std::exchange(run, store.next(run)));
    }
    if (envelope != no_index) store.give_back(envelope);
    return all;
}

// Merges neighbours that are not served, as far as the error allows; returns how many are left.
Index merge_neighbours(WindowFront& front, std::span<Window> windows) {
    Index kept = 0;
    for (Index i = 1; i < windows.size(); ++i) {
        Window& last = windows[kept];
        const Window& next = windows[i];
        if (!last.is_served && !next.is_served) {
            if (const auto merged = merge_windows(last, next, front.max_error)) {
                last = *merged;
                front.relative_error = std::max(front.relative_error, last.error / last.nearest());
                continue;
            }
        }
        windows[++kept] = next;
    }
    return kept + 1;
}

// \return the run of the envelope, of which `count` windows are left; no_index: none.
Index settle(WindowFront& front, Index run, Index count) {
    if (front.max_error > 0 && count > 0) {
        count = merge_neighbours(front, front.store[run].first(count));
    }
    if (count == 0) {
        front.store.give_back(run);
        return no_index;
    }
    front.store.resize(run, count);
    assert(is_envelope(front.store[run]));
    return run;
}

// Inserts the windows from index i on, out of order, into the envelope that the first `kept` are.
Index insert_rest(WindowFront& front, Index run, Index kept, Index i, const WindowFace& face) {
    const std::span<Window> windows = front.store[run];
    const double middle = meeting_point(face);
    std::vector<Window>& envelope = front.scratch.envelope;
    envelope.assign(windows.begin(), windows.begin() + kept);
    for (; i < windows.size(); ++i) {
        Window& w = windows[i];
        if (!w.is_served && is_beaten(w, face, middle)) continue;
        if (!comes_in_order(envelope, w)) {
            insert_window(w, front.scratch.insertion, envelope);
        } else if (w.begin < w.end) {
            envelope.push_back(w);
        }
    }
    const auto count = static_cast<Index>(envelope.size());
    if (count > front.store.room(run)) {
        front.store.give_back(run);
        run = front.store.take(count);
    }
    front.store.resize(run, count);
    std::copy(envelope.begin(), envelope.end(), front.store[run].begin());
    return settle(front, run, count);
}

// Reaches the apex along a ray that bends at one end of a window. That gives a bound only.
void reach_bent(WindowFront& front, const WindowFace& face, double distance, double at,
                float error) {
    const VertexRecord& apex = front.vertices.records[face.apex_record];
    const Vec2 rest(face.apex_x - at, face.apex_y);
    const double limit = apex.upper - error - distance;
    if (!(limit > 0 && rest.squaredNorm() < limit * limit)) return;  // Most end here: no root.
    front.vertices.lower_bound(face.apex_record, distance + rest.norm() + error);
}

// Reaches the apex along a straight ray. Returns the distance of the apex.
double reach_apex(WindowFront& front, const Window& w, double ray, const WindowFace& face) {
    const Vec2 to_image(w.x - face.apex_x, w.y - face.apex_y);
    const double at_apex = w.weight + to_image.norm();
    // A merged window's end ray touches the apex on one side only, and others go past it on
    // the other side in other directions.
    const bool touches = w.error > 0 && !(w.begin < ray && ray < w.end);
    const VertexRecord& apex = front.vertices.records[face.apex_record];
    const bool may_be_pseudo_source =
        front.max_error > 0 && front.surface.can_be_pseudo_source[apex.vertex] != 0;
    if (at_apex < apex.low || may_be_pseudo_source) {
        reach_vertex(front, face.apex_record,
                     {at_apex, w.error, touches ? no_index : Surface::previous(face.half_edge),
                      into(Vec2(-face.left_x, -face.left_y), to_image)});
    } else {
        front.vertices.lower_bound(face.apex_record, at_apex + w.error);
    }
    return at_apex;
}

// Splits a window at the ray to the apex. One angle, one split: rays that cross the best one on
// its way to the apex lead nowhere ([chen1990]).
Division split(const Window& w, double ray, double at_apex, EdgeRecord& edge) {
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

// Real meshes stay below 700. Around a spike that is 10^9 times as long as wide, windows circle
// until rounding ends it: a million of them, each copied a thousand times.
constexpr Index most_windows = 1 << 11;

// Fewer where a distance's rounding exceeds the width of the face.
Index most_windows_through(const WindowFront& front, const EdgeRecord& edge,
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

// Divides the windows of the half-edge that have not been sent on.
void divide_windows(WindowFront& front, EdgeRecord& edge, const WindowFace& face) {
    RunArray<Division>& divisions = front.scratch.divisions;
    divisions.clear();
    for (Window& window : front.store[edge.windows]) {
        if (window.is_served) continue;
        window.is_served = true;
        divisions.push(divide(front, window, edge, face));
    }
    edge.num_served += divisions.size();
    front.num_served += divisions.size();
}

// Sends on the parts to one side that live.
template <auto part>
void pass_on(WindowFront& front, const WindowFace& face, const HalfEdgeEnds& to) {
    if (to.half_edge == no_index) return;
    Index count = 0;
    for (const Division& d : front.scratch.divisions) count += (d.*part).window == nullptr ? 0 : 1;
    if (count == 0) return;
    SentWindows sent{front.store.take(count), 0, infinity};
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
    send(front, to, sent);
}

}  // namespace

void take_in_windows(WindowFront& front, EdgeRecord& edge, const WindowFace& face) {
    assert(edge.half_edge == face.half_edge && edge.waiting != no_index);
    const Index waiting = std::exchange(edge.waiting, no_index);
    Index run = waiting;
    if (edge.windows != no_index || front.store.next(waiting) != no_index) {
        run = gather(front, waiting, edge.windows);
        edge.windows = no_index;
    }
    const std::span<Window> windows = front.store[run];
    const double middle = meeting_point(face);
    Index kept = 0;
    for (Index i = 0; i < windows.size(); ++i) {
        Window& w = windows[i];
        // The envelope's own are served and stay.
        if (!w.is_served && is_beaten(w, face, middle)) continue;
        if (!comes_in_order(windows.first(kept), w)) {
            edge.windows = insert_rest(front, run, kept, i, face);
            return;
        }
        if (w.begin == w.end) continue;
        if (kept < i) windows[kept] = w;
        ++kept;
    }
    edge.windows = settle(front, run, kept);
}

Division divide(WindowFront& front, const Window& w, EdgeRecord& edge, const WindowFace& face) {
    const double ray = (w.x * face.apex_y - w.y * face.apex_x) / (face.apex_y - w.y);
    const double slack =
        grazing * std::min(face.length, std::min(w.at_begin, w.at_end) - w.weight) +
        frame_rounding * face.length;
    if (ray < w.begin - slack) {
        reach_bent(front, face, w.at_begin, w.begin, w.error);
    } else if (ray > w.end + slack) {
        reach_bent(front, face, w.at_end, w.end, w.error);
    } else {
        const double at_apex = reach_apex(front, w, ray, face);
        if (w.begin < ray && ray < w.end) return split(w, ray, at_apex, edge);
    }
    if (ray <= w.begin) return {{&w, w.begin, false}, {}};
    return {{}, {&w, w.end, false}};
}

void serve_edge(WindowFront& front, Index record) {
    EdgeRecord& edge = front.edges.records[record];
    if (edge.waiting == no_index) return;
    WindowFace face(front.corners, edge.half_edge);
    face.tail_bound = front.vertices.records[edge.tail].bound;
    face.head_bound = front.vertices.records[edge.head].bound;
    if (edge.num_served > most_windows_through(front, edge, face)) {
        while (edge.waiting != no_index) {
            front.store.give_back(std::exchange(edge.waiting, front.store.next(edge.waiting)));
        }
        front.relative_error = infinity;
        return;
    }
    if (may_close(front) && !std::exchange(edge.is_watched, true)) {
        watch(front, record, front.queue.current() + 3);
    }
    take_in_windows(front, edge, face);
    if (edge.windows == no_index) return;
    face.apex_record = vertex_record(front, face.previous.tail);

    front.ticker.tick(front.store[edge.windows].size());
    divide_windows(front, edge, face);
    face.apex_bound = front.vertices.records[face.apex_record].bound;
    const Index tail = edge.tail, head = edge.head;  // Records may move.
    pass_on<&Division::right>(front, face, {face.next.twin, face.apex_record, head});
    pass_on<&Division::left>(front, face, {face.previous.twin, tail, face.apex_record});
}

}  // namespace agvd
