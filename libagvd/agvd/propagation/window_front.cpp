// Sources: [mitchell1987] windows, [chen1990] one angle, one split, [xin2009] filters. What
// differs: windows die by bounds that all sites share, half-edges wait in buckets and are served
// with all their windows at once, and every half-edge keeps the lower envelope of its windows.

#include "agvd/propagation/window_front.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "agvd/propagation/window_envelope.h"
#include "agvd/propagation/window_rays.h"

namespace agvd {
namespace {

// Sine of the angle of a beam: a narrower one carries nothing but rounding. What it would have
// reached is reached along the beams beside it, longer by the square of this.
constexpr double negligible = 1e-13;

// Of a distance and an edge: what two ways to compute it may differ by after thousands of faces,
// and beside a vertex. A path along edges must not kill the straight one that it is.
constexpr double rounding = 1e-12;

// Of the edge: what a frame's coordinates may be off by after some turns.
constexpr double frame_rounding = 1e-14;

// |v| < limit, without a root.
bool is_within(const Vec2& v, double limit) { return limit > 0 && v.squaredNorm() < limit * limit; }

// Where the paths along the edge from both its ends meet, inside an interval: if a window is beaten
// there it is beaten everywhere, by the tail before and by the head behind.
double meeting_point(double tail_bound, double head_bound, double length, double begin,
                     double end) {
    return std::min(std::max(begin, (head_bound + length - tail_bound) / 2), end);
}

constexpr Index turn_item(Index turn) { return 2 * turn + 1; }
constexpr Index edge_item(Index record) { return 2 * record; }

}  // namespace

// The face above a half-edge: tail at (0, 0), head at (length, 0). Windows leave it through the
// next half-edge (right) and the previous one (left); the frames of their twins start at the apex
// and at the tail. Plain numbers, since compilers tear vectors apart and stall where they join them
// again.
struct WindowFront::Face {
    Face(const Corners& corners, Index base_half_edge)
        : half_edge(base_half_edge),
          base(corners[half_edge]),
          next(corners[Surface::next(half_edge)]),
          previous(corners[Surface::previous(half_edge)]),
          length(base.length),
          apex_x(base.turn.x() * length),
          apex_y(base.turn.y() * length),
          right_x((length - apex_x) / next.length),
          right_y(-apex_y / next.length),
          left_x(apex_x / previous.length),
          left_y(apex_y / previous.length) {}

    Index half_edge;
    const Corner& base;
    const Corner& next;
    const Corner& previous;
    double length;
    double apex_x, apex_y;
    double right_x, right_y;  // Unit vector from the apex to the head.
    double left_x, left_y;    // From the tail to the apex.
    double tail_bound = 0, head_bound = 0, apex_bound = 0;
    Index apex_record = no_index;
};

WindowFront::WindowFront(const Surface& surface, const Corners& corners, double max_error,
                         Ticker ticker)
    : surface_(surface),
      corners_(corners),
      per_bucket_(3 / corners.mean_length()),
      max_error_(max_error),
      ticker_(ticker),
      vertex_slot_(surface.num_vertices(), 0),
      edge_slot_(surface.twin.size(), 0) {}

void WindowFront::run(const SurfacePoint& site, std::span<const float> bounds, Index work_cap) {
    bounds_ = bounds;
    if (run_in(Order::Buckets, site, work_cap)) return;
    (void)run_in(Order::Nearest, site, no_index);
}

// False if the cap was passed; what the front then holds means nothing.
bool WindowFront::run_in(Order order, const SurfacePoint& site, Index work_cap) {
    queue_order_ = order;
    vertices_.clear();
    edges_.clear();
    turns_.clear();
    pool_.clear();
    runs_.clear();
    free_runs_.fill(no_index);
    if (num_waiting_ > 0) {  // The last run was broken off.
        for (auto& bucket : buckets_) bucket.clear();
    }
    heap_.clear();
    current_bucket_ = 0;
    next_in_bucket_ = 0;
    num_waiting_ = 0;
    num_served_ = 0;
    relative_error_ = 0;

    start(site);
    Index item = 0;
    while (next_item(item)) {
        if (item % 2 == 1) {
            emit(Turn(turns_[item / 2]));  // A copy: it may cause others.
        } else {
            serve_edge(item / 2);
            if (edges_[item / 2].num_served > work_cap) return false;
        }
    }
    return true;
}

std::size_t WindowFront::bytes() const {
    std::size_t sum = (vertex_slot_.capacity() + edge_slot_.capacity()) * sizeof(Index) +
                      vertices_.bytes() + edges_.bytes() + turns_.bytes() + runs_.bytes() +
                      pool_.bytes() + heap_.capacity() * sizeof(heap_[0]);
    for (const auto& bucket : buckets_) sum += bucket.capacity() * sizeof(Index);
    return sum;
}

Index WindowFront::vertex_record(Index vertex) {
    Index& slot = vertex_slot_[vertex];
    if (slot < vertices_.size() && vertices_[slot].vertex == vertex) return slot;
    const double bound = bounds_[vertex];
    return slot = vertices_.push({vertex, bound, bound});
}

inline Index WindowFront::edge_record(Index half_edge, Index tail, Index head) {
    Index& slot = edge_slot_[half_edge];
    if (slot < edges_.size() && edges_[slot].half_edge == half_edge) return slot;
    corners_.prefetch(Surface::face(half_edge));
    return slot = edges_.push({half_edge, tail, head});
}

// --- Queue -----------------------------------------------------------------------------------

inline void WindowFront::schedule(Index item, Index& bucket, double distance) {
    if (queue_order_ == Order::Nearest) {
        heap_.emplace_back(distance, item);
        std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
        return;
    }
    constexpr double last_bucket = 1 << 20;
    const auto place = std::max(static_cast<Index>(std::min(distance * per_bucket_, last_bucket)),
                                current_bucket_);
    if (bucket <= place) return;
    bucket = place;
    if (place >= buckets_.size()) buckets_.resize(place + 1);
    buckets_[place].push_back(item);
    ++num_waiting_;
}

// What an item needs after its corners, and what is seldom in the cache.
[[gnu::always_inline]] inline void WindowFront::prefetch(Index item) const {
    if (item % 2 == 1) return;
    const Index half_edge = edges_[item / 2].half_edge;
    const Corner& next = corners_[Surface::next(half_edge)];
    const Corner& previous = corners_[Surface::previous(half_edge)];
    __builtin_prefetch(&vertex_slot_[previous.tail]);
    __builtin_prefetch(&bounds_[previous.tail]);
    if (next.twin != no_index) __builtin_prefetch(&edge_slot_[next.twin]);
    if (previous.twin != no_index) __builtin_prefetch(&edge_slot_[previous.twin]);
}

bool WindowFront::next_item(Index& item) {
    if (queue_order_ == Order::Nearest) {
        if (heap_.empty()) return false;
        std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
        item = heap_.back().second;
        heap_.pop_back();
        return true;
    }
    while (num_waiting_ > 0) {
        std::vector<Index>& bucket = buckets_[current_bucket_];
        if (bucket.empty()) {
            ++current_bucket_;
            continue;
        }
        item = bucket[next_in_bucket_++];
        --num_waiting_;
        if (next_in_bucket_ < bucket.size()) {
            prefetch(bucket[next_in_bucket_]);
        } else {
            bucket.clear();
            next_in_bucket_ = 0;
        }
        if (item % 2 == 1) return true;
        Index& waits_in = edges_[item / 2].bucket;
        if (waits_in != current_bucket_) continue;  // Served from an earlier bucket.
        waits_in = no_index;
        return true;
    }
    return false;
}

// --- Vertices ----------------------------------------------------------------------------------

// Arrivals within each other's error may turn at a vertex one after the other, and send each other
// back and forth between vertices that lie closer than the error. After so many the whole fan is
// emitted, which holds all their shadows.
constexpr Index max_turns = 32;

// By a path that is straight where it arrives. It comes from `arrival` in the frame of the
// half-edge, or from no known direction.
void WindowFront::reach_vertex(Index record, double distance, float error, Index half_edge,
                               const Vec2& arrival) {
    bound_vertex(record, distance + error);
    VertexRecord& v = vertices_[record];
    const bool is_nearest = distance < v.low;
    if (is_nearest) v.low = distance;
    if (surface_.can_turn[v.vertex] == 0 || !(distance <= v.bound * (1 + grazing))) return;
    // Of exact arrivals the nearest tells where the shadow lies; of others any may.
    if (!is_nearest && (max_error_ == 0 || distance == v.last_arrival)) return;
    v.last_arrival = distance;
    if (++v.num_turns > max_turns) {
        if (v.num_turns > max_turns + 1 && !is_nearest) return;
        half_edge = no_index;
    }
    Index bucket = no_index;
    schedule(turn_item(turns_.push({record, half_edge, arrival, distance})), bucket, distance);
}

// By any path on the surface.
void WindowFront::bound_vertex(Index record, double distance) {
    VertexRecord& v = vertices_[record];
    v.upper = std::min(v.upper, distance);
    v.bound = std::min(v.bound, v.upper);
}

// --- Half-edges --------------------------------------------------------------------------------

// Memory for a run: its size is a power of two, and runs of that size that were given back come
// first.
inline Index WindowFront::take_run(Index count) {
    const int size_class = std::bit_width(count - 1);
    Index& free_run = free_runs_[static_cast<std::size_t>(size_class)];
    if (free_run == no_index) {
        return runs_.push({pool_.extend(Index{1} << size_class), count, no_index});
    }
    const Index run = free_run;
    free_run = runs_[run].next;
    runs_[run].count = count;
    return run;
}

void WindowFront::give_back(Index run) {
    Index& free_run = free_runs_[static_cast<std::size_t>(std::bit_width(runs_[run].count - 1))];
    runs_[run].next = free_run;
    free_run = run;
}

void WindowFront::send(Index half_edge, Index tail, Index head, std::span<const Window> windows) {
    if (windows.empty()) return;
    const Index record = edge_record(half_edge, tail, head);
    const auto count = static_cast<Index>(windows.size());
    EdgeRecord& edge = edges_[record];
    const Index run = take_run(count);
    runs_[run].next = edge.waiting;
    edge.waiting = run;
    double nearest = infinity;
    Window* const to = &pool_[runs_[run].first];
    for (Index i = 0; i < count; ++i) {
        nearest = std::min(nearest, windows[i].nearest());
        to[i] = windows[i];
    }
    schedule(edge_item(record), edge.bucket, nearest);
}

// Merges the windows that wait, which come in ascending runs, into the envelope of the half-edge.
inline void WindowFront::take_in(EdgeRecord& edge, const Face& face) {
    const auto is_beaten = [&](const Window& w) {
        const double at =
            meeting_point(face.tail_bound, face.head_bound, face.length, w.begin, w.end);
        const double around = std::min(face.tail_bound + at, face.head_bound + face.length - at) -
                              w.weight + rounding * (w.at_begin + face.length);
        return (around <= 0) | (around * around < (at - w.x) * (at - w.x) + w.y * w.y);
    };
    const Index only = edge.waiting;
    edge.waiting = no_index;
    const bool is_alone = edge.windows == no_index && runs_[only].next == no_index;
    if (is_alone && runs_[only].count == 1) {  // Nine of ten at 2000 sites: it stays where it is.
        if (is_beaten(pool_[runs_[only].first])) {
            give_back(only);
        } else {
            edge.windows = only;
        }
        return;
    }
    order_.clear();
    if (edge.windows != no_index) {
        for (const Window& window : windows_of(edge.windows)) order_.push(&window);
    }
    for (Index run = only; run != no_index; run = runs_[run].next) {
        for (const Window& window : windows_of(run)) {
            if (is_beaten(window)) continue;
            const Index last = order_.extend(1);
            Index place = last;
            for (; place > 0 && window.begin < order_[place - 1]->begin; --place) {
                order_[place] = order_[place - 1];
            }
            order_[place] = &window;
            ticker_.tick(1 + (last - place) / 16);  // Moves are quick.
        }
    }
    envelope_.clear();
    for (const Window* window : order_) {
        insert_window(*window, scratch_, envelope_);
        ticker_.tick();
    }
    if (max_error_ > 0) merge_neighbours();
    for (Index run = only; run != no_index;) give_back(std::exchange(run, runs_[run].next));
    if (edge.windows != no_index) give_back(edge.windows);
    edge.windows = no_index;
    if (envelope_.empty()) return;
    edge.windows = take_run(static_cast<Index>(envelope_.size()));
    std::copy(envelope_.begin(), envelope_.end(), &pool_[runs_[edge.windows].first]);
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

void WindowFront::reach_bent(const Face& face, double distance, double at, float error) {
    const VertexRecord& apex = vertices_[face.apex_record];
    const Vec2 rest(face.apex_x - at, face.apex_y);
    if (!is_within(rest, apex.upper - error - distance)) return;
    bound_vertex(face.apex_record, distance + rest.norm() + error);
}

// Reaches the apex, and decides which part of the window goes on to the right and to the left.
inline WindowFront::Division WindowFront::divide(Window& w, EdgeRecord& edge, const Face& face) {
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

// Whether a child may matter: it is wide enough, and no path around the ends of its edge or past
// the corner behind it is shorter.
inline bool WindowFront::lives(const Window& child, double begin_bound, double end_bound,
                               double length, double spare, double to_corner) {
    const double to_begin = child.at_begin - child.weight;
    const double to_end = child.at_end - child.weight;
    const double at = meeting_point(begin_bound, end_bound, length, child.begin, child.end);
    const double around = std::min(begin_bound + at, end_bound + length - at) - child.weight +
                          rounding * (child.at_begin + length);
    const bool is_wide = ((child.begin - child.end) * child.y > negligible * to_begin * to_end) |
                         ((child.begin < child.x) & (child.x < child.end) & (child.y < 0));
    return is_wide & (around >= 0) &
           (around * around >= (at - child.x) * (at - child.x) + child.y * child.y) &
           ((spare <= 0) | (to_corner >= spare * spare));
}

// The part that goes on through the next half-edge. In the frame beyond, the apex is at 0, and a
// point of the base at a distance s before the head is at (length, 0) - s (right_x, sine). False if
// it dies; found without branches, since that cannot be predicted.
inline bool WindowFront::pass_right(const Part& part, const Face& face, Window& child) {
    const Window& w = *part.window;
    const double length = face.next.length;
    const double sine = face.apex_y / length;  // Of the angle at the head.
    const double dx = w.x - face.apex_x;
    const double dy = w.y - face.apex_y;
    const double x = dx * face.right_x + dy * face.right_y;
    const double y = dy * face.right_x - dx * face.right_y;
    const auto seen_at = [&](double at) {
        const double s = face.length - at;
        const double from_x = length - s * face.right_x;
        return x + (from_x - x) * y / (y + s * sine);
    };
    const double begin = part.is_apex ? 0.0 : std::max(seen_at(part.limit), 0.0);
    const double end = w.end == face.length ? length : std::min(seen_at(w.end), length);
    child = {x,
             y,
             w.weight,
             begin,
             end,
             w.weight + std::sqrt((begin - x) * (begin - x) + y * y),
             w.weight + std::sqrt((end - x) * (end - x) + y * y),
             w.error};
    const double tail_x = length - face.length * face.right_x;
    const double tail_y = -face.length * sine;
    const double to_tail = (tail_x - end) * (tail_x - end) + tail_y * tail_y;
    return lives(child, face.apex_bound, face.head_bound, length,
                 child.at_end - face.tail_bound - rounding * (child.at_end + length), to_tail);
}

// The same through the previous half-edge: the tail at 0, the apex at `length`.
inline bool WindowFront::pass_left(const Part& part, const Face& face, Window& child) {
    const Window& w = *part.window;
    const double length = face.previous.length;
    const double x = w.x * face.left_x + w.y * face.left_y;
    const double y = w.y * face.left_x - w.x * face.left_y;
    const auto seen_at = [&](double at) {
        return x + (at * face.left_x - x) * y / (y + at * face.left_y);
    };
    const double begin = w.begin == 0 ? 0.0 : std::max(seen_at(w.begin), 0.0);
    const std::array ends{std::min(seen_at(part.limit), length), length};
    const double end = ends[static_cast<std::size_t>(part.is_apex)];
    child = {x,
             y,
             w.weight,
             begin,
             end,
             w.weight + std::sqrt((begin - x) * (begin - x) + y * y),
             w.weight + std::sqrt((end - x) * (end - x) + y * y),
             w.error};
    const double head_x = face.length * face.left_x;
    const double head_y = -face.length * face.left_y;
    const double to_head = (head_x - begin) * (head_x - begin) + head_y * head_y;
    return lives(child, face.tail_bound, face.apex_bound, length,
                 child.at_begin - face.head_bound - rounding * (child.at_begin + length), to_head);
}

// Takes in the windows that wait, and sends on what has not been sent on.
void WindowFront::serve_edge(Index record) {
    EdgeRecord& edge = edges_[record];
    if (edge.waiting == no_index) return;
    Face face(corners_, edge.half_edge);
    face.tail_bound = vertices_[edge.tail].bound;
    face.head_bound = vertices_[edge.head].bound;
    take_in(edge, face);
    if (edge.windows == no_index) return;
    face.apex_record = vertex_record(face.previous.tail);

    const Run run = runs_[edge.windows];
    ticker_.tick(run.count);
    divisions_.clear();
    for (Index i = run.first; i < run.first + run.count; ++i) {
        if (!pool_[i].is_served) divisions_.push(divide(pool_[i], edge, face));
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
