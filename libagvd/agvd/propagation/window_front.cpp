// Sources: [mitchell1987] windows, [chen1990] one angle, one split, [xin2009] filters. What differs:
// windows die by bounds that all sites share, half-edges wait in buckets and are served with all
// their windows at once, and every half-edge keeps the lower envelope of its windows.

#include "agvd/propagation/window_front.h"

#include <algorithm>

#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/window_envelope.h"

namespace agvd {
namespace {

// Relative to an edge: narrower windows and flatter images carry nothing but rounding. What they
// would have reached is reached along the windows beside them, longer by the square of this.
constexpr double negligible = 1e-13;

// A ray this close to a window's end (relative to the edge) is not bent.
constexpr double grazing = 1e-10;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

// A vector in the frame whose x axis is the unit vector `axis`, and back.
Vec2 into(const Vec2& axis, const Vec2& v) { return {axis.dot(v), cross(axis, v)}; }

constexpr Index vertex_item(Index record) { return 2 * record + 1; }
constexpr Index edge_item(Index record) { return 2 * record; }

}  // namespace

// The face above a half-edge: tail at (0, 0), head at (length, 0). `right` and `left` are its other
// half-edges seen from the faces beyond; their frames start at the apex and at the tail.
struct WindowFront::Face {
    Face(const Surface& surface, Index half_edge)
        : half_edge(half_edge),
          to_right(surface.twin[Surface::next(half_edge)]),
          to_left(surface.twin[Surface::previous(half_edge)]),
          length(surface.length_of(half_edge)),
          right_length(surface.length_of(Surface::next(half_edge))),
          left_length(surface.length_of(Surface::previous(half_edge))),
          apex(surface.apex[half_edge]),
          right_axis((Vec2(length, 0) - apex) / right_length),
          left_axis(apex / left_length) {}

    Index half_edge;
    Index to_right, to_left;
    double length, right_length, left_length;
    Vec2 apex;
    Vec2 right_axis, left_axis;
    double tail_bound = 0, head_bound = 0, apex_bound = 0;
    Index apex_record = no_index;
};

WindowFront::WindowFront(const Surface& surface, double bucket_width, double max_error)
    : surface_(surface),
      per_bucket_(1 / bucket_width),
      max_error_(max_error),
      vertex_slot_(surface.num_vertices(), 0),
      edge_slot_(surface.twin.size(), 0) {}

bool WindowFront::run(const SurfacePoint& site, std::span<const float> bounds, FrontOrder order,
                      Index work_cap) {
    bounds_ = bounds;
    order_ = order;
    vertices_.clear();
    edges_.clear();
    arrivals_.clear();
    free_arrival_ = no_index;
    pool_.clear();
    for (auto& bucket : buckets_) bucket.clear();
    heap_.clear();
    current_bucket_ = 0;
    num_waiting_ = 0;
    num_served_ = 0;

    start(site);
    Index item = 0;
    while (next_item(item)) {
        if (item % 2 == 1) {
            emit(item / 2);
        } else {
            serve_edge(item / 2);
            if (edges_[item / 2].num_served > work_cap) return false;
        }
    }
    return true;
}

std::size_t WindowFront::bytes() const {
    std::size_t sum = (vertex_slot_.capacity() + edge_slot_.capacity()) * sizeof(Index) +
                      vertices_.capacity() * sizeof(VertexRecord) +
                      edges_.capacity() * sizeof(EdgeRecord) +
                      arrivals_.capacity() * sizeof(Arrival) + pool_.capacity() * sizeof(Window) +
                      heap_.capacity() * sizeof(heap_[0]);
    for (const auto& bucket : buckets_) sum += bucket.capacity() * sizeof(Index);
    return sum;
}

Index WindowFront::vertex_record(Index vertex) {
    Index& slot = vertex_slot_[vertex];
    if (slot < vertices_.size() && vertices_[slot].vertex == vertex) return slot;
    slot = static_cast<Index>(vertices_.size());
    const double bound = bounds_[vertex];
    vertices_.push_back({vertex, no_index, {0, 0}, bound, bound});
    return slot;
}

Index WindowFront::edge_record(Index half_edge) {
    Index& slot = edge_slot_[half_edge];
    if (slot < edges_.size() && edges_[slot].half_edge == half_edge) return slot;
    slot = static_cast<Index>(edges_.size());
    edges_.push_back({half_edge});
    return slot;
}

// --- Queue -----------------------------------------------------------------------------------

void WindowFront::schedule(Index item, Index& bucket, double distance) {
    if (order_ == FrontOrder::Nearest) {
        heap_.emplace_back(distance, item);
        std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
        return;
    }
    constexpr double last_bucket = 1 << 20;
    const auto place = std::max(
        static_cast<Index>(std::min(distance * per_bucket_, last_bucket)), current_bucket_);
    if (bucket <= place) return;
    bucket = place;
    if (place >= buckets_.size()) buckets_.resize(place + 1);
    buckets_[place].push_back(item);
    ++num_waiting_;
}

bool WindowFront::next_item(Index& item) {
    if (order_ == FrontOrder::Nearest) {
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
        item = bucket.back();
        bucket.pop_back();
        --num_waiting_;
        Index& waits_in = item % 2 == 1 ? vertices_[item / 2].bucket : edges_[item / 2].bucket;
        if (waits_in != current_bucket_) continue;  // Served from an earlier bucket.
        waits_in = no_index;
        return true;
    }
    return false;
}

// --- Vertices ----------------------------------------------------------------------------------

void WindowFront::reach_vertex(Index record, double distance, float error, Index half_edge,
                               const Vec2& arrival) {
    VertexRecord& v = vertices_[record];
    v.upper = std::min(v.upper, distance + error);
    // A bent path may tie with the straight one, which alone says where the shadow lies.
    const bool is_bent = half_edge == no_index;
    const bool was_bent = v.arrival_half_edge == no_index;
    const double least = is_bent && !was_bent ? v.low * (1 - grazing)
                         : was_bent && !is_bent ? v.low * (1 + grazing)
                                                : v.low;
    const bool takes_over = distance < least;
    v.low = std::min(v.low, distance);
    v.bound = std::min(v.bound, v.low);
    if (!takes_over) return;
    v.error = error;
    v.arrival_half_edge = half_edge;
    v.arrival = arrival;
    if (!is_bent && surface_.can_turn[v.vertex] && v.low <= v.outer_bound) {
        schedule(vertex_item(record), v.bucket, v.low);
    }
}

void WindowFront::start(const SurfacePoint& site) {
    if (const auto vertex = vertex_of(surface_, site)) {
        const Index record = vertex_record(*vertex);
        VertexRecord& v = vertices_[record];
        v.low = v.upper = v.bound = v.emitted = 0;
        Index h = surface_.outgoing[*vertex];
        if (h == no_index) return;
        do {
            emit_into(h, 0, 0, nullptr, nullptr);
            h = surface_.twin[Surface::previous(h)];
        } while (h != no_index && h != surface_.outgoing[*vertex]);
        return;
    }
    const auto spread = [&](const SurfacePoint& point, Index skipped) {
        for (Index k = 0; k < 3; ++k) {
            const Index h = 3 * point.face.value() + k;
            const Vec2 p = position_in_frame(surface_, point, h);
            reach_vertex(vertex_record(surface_.tail(h)), p.norm(), 0, h, p);
            if (h == skipped || surface_.twin[h] == no_index) continue;
            const double length = surface_.length_of(h);
            const Vec2 image(length - p.x(), -p.y());
            if (!(image.y() < -negligible * length)) continue;
            send(surface_.twin[h], {image.x(), image.y(), 0, 0, length, image.norm(),
                                    (image - Vec2(length, 0)).norm()});
        }
    };
    const auto half_edge = half_edge_of(site);
    spread(site, half_edge.value_or(no_index));
    if (half_edge && surface_.twin[*half_edge] != no_index) {
        spread(across_edge(surface_, site, *half_edge), surface_.twin[*half_edge]);
    }
}

// Windows from the tail of `half_edge` onto the opposite edge of its face; `from` and `to`, if
// given, are rays that bound the fan, in the frame of the half-edge.
void WindowFront::emit_into(Index half_edge, double weight, float error, const Vec2* from,
                            const Vec2* to) {
    const Index opposite = Surface::next(half_edge);
    const Index back = Surface::previous(half_edge);
    const Vec2& vertex = surface_.apex[opposite];
    const double first_length = surface_.length_of(half_edge);
    const double last_length = surface_.length_of(back);
    reach_vertex(vertex_record(surface_.head(half_edge)), weight + first_length, error, opposite,
                 vertex);
    reach_vertex(vertex_record(surface_.tail(back)), weight + last_length, error, back,
                 {last_length, 0});
    const Index beyond = surface_.twin[opposite];
    if (beyond == no_index) return;
    const double length = surface_.length_of(opposite);
    const Vec2 image(length - vertex.x(), -vertex.y());
    if (!(image.y() < -negligible * length)) return;
    // The frame of `beyond` starts at the apex of `half_edge` and runs clockwise around the vertex.
    Window window{image.x(), image.y(), weight, 0, length, weight + last_length,
                  weight + first_length, error};
    const Vec2 axis = (Vec2(first_length, 0) - surface_.apex[half_edge]) / length;
    const auto meets_at = [&](const Vec2& ray) {
        const Vec2 direction = into(axis, ray);
        return image.x() - image.y() * direction.x() / direction.y();
    };
    const double slack = grazing * length;
    if (from) {  // The fan lies to the left of this ray: nearer the apex.
        const double at = std::max(meets_at(*from) + slack, 0.0);
        if (into(axis, *from).y() > 0 && at < length) window = window.part(0, at);
    }
    if (to) {
        const double at = meets_at(*to) - slack;
        if (into(axis, *to).y() > 0 && at > 0) {
            if (!(at < window.end)) return;
            window = window.part(at, window.end);
        }
    }
    send(beyond, window);
}

// The shadow behind a saddle or boundary vertex: the directions that make an angle of pi or more
// with the arrival on both sides. Faces are unfolded around the vertex one after the other.
void WindowFront::emit(Index record) {
    const VertexRecord v = vertices_[record];
    if (v.arrival_half_edge == no_index || v.emitted == v.low || !(v.low <= v.outer_bound)) return;
    vertices_[record].emitted = v.low;

    // Counter-clockwise: the arrival in the frame of each next half-edge turns clockwise, and has
    // turned by pi where it comes up again.
    Index first = no_index;
    Vec2 from = v.arrival;
    for (Index h = v.arrival_half_edge; h != no_index;) {
        const Vec2 turned = into(surface_.apex[h].normalized(), from);
        if (h != v.arrival_half_edge && from.y() <= 0 && turned.y() > 0) {
            first = h;
            break;
        }
        from = turned;
        h = surface_.twin[Surface::previous(h)];
        if (h == v.arrival_half_edge) break;
    }
    // Clockwise, the other way round.
    Index last = no_index;
    Vec2 to = v.arrival;
    for (Index twin = surface_.twin[v.arrival_half_edge]; twin != no_index;) {
        const Index h = Surface::next(twin);
        if (h == v.arrival_half_edge) break;
        const Vec2 corner = surface_.apex[h].normalized();
        const Vec2 turned(corner.x() * to.x() - corner.y() * to.y(),
                          corner.x() * to.y() + corner.y() * to.x());
        const bool is_behind = to.y() >= 0 && turned.y() < 0;
        to = turned;
        if (is_behind) {
            last = h;
            break;
        }
        twin = surface_.twin[h];
    }
    from = -from;
    to = -to;
    const bool is_boundary = surface_.is_boundary_vertex(v.vertex);
    if (last != no_index && (is_boundary || first == no_index)) {
        emit_fan(is_boundary ? surface_.outgoing[v.vertex] : last, nullptr, last, &to, v);
    }
    if (first != no_index) {
        emit_fan(first, &from, is_boundary ? no_index : last, &to, v);
    }
}

void WindowFront::emit_fan(Index first, const Vec2* from, Index last, const Vec2* to,
                           const VertexRecord& v) {
    for (Index h = first; h != no_index; h = surface_.twin[Surface::previous(h)]) {
        emit_into(h, v.low, v.error, h == first ? from : nullptr, h == last ? to : nullptr);
        if (h == last) break;
    }
}

// --- Half-edges --------------------------------------------------------------------------------

void WindowFront::send(Index half_edge, const Window& window) {
    const Index record = edge_record(half_edge);
    Index place = free_arrival_;
    if (place == no_index) {
        place = static_cast<Index>(arrivals_.size());
        arrivals_.push_back({window, no_index});
    } else {
        free_arrival_ = arrivals_[place].next;
        arrivals_[place].window = window;
    }
    EdgeRecord& edge = edges_[record];
    arrivals_[place].next = edge.arrivals;
    edge.arrivals = place;
    schedule(edge_item(record), edge.bucket, window.nearest());
}

// Takes in the windows that wait, and sends on what has not been sent on.
void WindowFront::serve_edge(Index record) {
    if (edges_[record].arrivals == no_index) return;
    Face face(surface_, edges_[record].half_edge);
    const double tail_bound = vertices_[vertex_record(surface_.tail(face.half_edge))].bound;
    const double head_bound = vertices_[vertex_record(surface_.head(face.half_edge))].bound;
    face.tail_bound = tail_bound;
    face.head_bound = head_bound;
    face.apex_record = vertex_record(surface_.tail(Surface::previous(face.half_edge)));

    {
        EdgeRecord& edge = edges_[record];
        envelope_.assign(pool_.begin() + edge.first_window,
                         pool_.begin() + edge.first_window + edge.num_windows);
        Index place = edge.arrivals;
        edge.arrivals = no_index;
        while (place != no_index) {
            const Window& window = arrivals_[place].window;
            const bool is_beaten = tail_bound + window.end < window.at_end ||
                                   head_bound + face.length - window.begin < window.at_begin;
            if (!is_beaten) {
                next_envelope_.clear();
                insert_window(envelope_, window, negligible * face.length, next_envelope_);
                envelope_.swap(next_envelope_);
            }
            const Index next = arrivals_[place].next;
            arrivals_[place].next = free_arrival_;
            free_arrival_ = place;
            place = next;
        }
        if (max_error_ > 0) merge_neighbours();
        if (envelope_.size() > edge.num_windows) {
            edge.first_window = static_cast<Index>(pool_.size());
            pool_.resize(pool_.size() + envelope_.size());
        }
        edge.num_windows = static_cast<Index>(envelope_.size());
    }
    for (Window& window : envelope_) {
        if (window.is_served) continue;
        window.is_served = true;
        ++num_served_;
        ++edges_[record].num_served;
        serve_window(window, record, face);
    }
    std::copy(envelope_.begin(), envelope_.end(), pool_.begin() + edges_[record].first_window);
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

void WindowFront::serve_window(const Window& w, Index record, Face& face) {
    const Vec2& apex = face.apex;
    const Vec2 to_image(w.x - apex.x(), w.y - apex.y());
    const double ray = (w.x * apex.y() - w.y * apex.x()) / (apex.y() - w.y);
    const double slack = grazing * face.length;
    double at_apex = infinity;
    if (ray < w.begin - slack) {
        const double bent = w.at_begin + (apex - Vec2(w.begin, 0)).norm();
        reach_vertex(face.apex_record, bent, w.error, no_index, {0, 0});
    } else if (ray > w.end + slack) {
        const double bent = w.at_end + (apex - Vec2(w.end, 0)).norm();
        reach_vertex(face.apex_record, bent, w.error, no_index, {0, 0});
    } else {
        at_apex = w.weight + to_image.norm();
        reach_vertex(face.apex_record, at_apex, w.error, Surface::previous(face.half_edge),
                     into(-face.left_axis, to_image));
    }
    face.apex_bound = vertices_[face.apex_record].bound;
    double left_end = std::min(ray, w.end);
    double right_begin = std::max(ray, w.begin);
    if (w.begin < ray && ray < w.end) {
        // One angle, one split: rays that cross the best one on its way to the apex lead nowhere.
        EdgeRecord& edge = edges_[record];
        if (at_apex < edge.apex_distance) {
            edge.apex_distance = at_apex;
            edge.apex_ray = ray;
        } else if (ray < edge.apex_ray) {
            right_begin = std::max(right_begin, edge.apex_ray);
        } else {
            left_end = std::min(left_end, edge.apex_ray);
        }
    }
    if (face.to_right != no_index && right_begin < w.end) {
        send_right(w, face, right_begin, ray, at_apex);
    }
    if (face.to_left != no_index && w.begin < left_end) {
        send_left(w, face, left_end, ray, at_apex);
    }
}

// The part of the window from `from` on, seen through the next half-edge. In its frame the apex is
// at 0 and a point of the edge at a distance s before the head lies at (right_length, 0) - s times
// the direction from head to tail.
void WindowFront::send_right(const Window& w, const Face& face, double from, double ray,
                             double at_apex) {
    const Vec2 image = into(face.right_axis, Vec2(w.x, w.y) - face.apex);
    const double length = face.right_length;
    if (!(image.y() < -negligible * length)) return;
    const double sine = face.apex.y() / length;  // Of the angle at the head.
    const auto seen_at = [&](double at) {
        if (at == face.length) return length;
        const Vec2 p(length - (face.length - at) * face.right_axis.x(),
                     -(face.length - at) * sine);
        return image.x() + (p.x() - image.x()) * image.y() / (image.y() - p.y());
    };
    Window child{image.x(), image.y(), w.weight, 0, 0, 0, 0, w.error};
    child.begin = from == ray ? 0.0 : std::max(seen_at(from), 0.0);
    child.end = std::min(seen_at(w.end), length);
    if (!(child.end - child.begin > negligible * length)) return;
    child.at_end = w.weight + (image - Vec2(child.end, 0)).norm();
    if (face.apex_bound + child.end < child.at_end) return;
    const Vec2 tail(length - face.length * face.right_axis.x(), -face.length * sine);
    if (face.tail_bound + (tail - Vec2(child.end, 0)).norm() < child.at_end) return;
    child.at_begin = from == ray && at_apex < infinity
                         ? at_apex
                         : w.weight + (image - Vec2(child.begin, 0)).norm();
    if (face.head_bound + length - child.begin < child.at_begin) return;
    send(face.to_right, child);
}

// The part of the window up to `to`, seen through the previous half-edge: the tail at 0, the apex
// at left_length.
void WindowFront::send_left(const Window& w, const Face& face, double to, double ray,
                            double at_apex) {
    const Vec2 image = into(face.left_axis, Vec2(w.x, w.y));
    const double length = face.left_length;
    if (!(image.y() < -negligible * length)) return;
    const auto seen_at = [&](double at) {
        if (at == 0) return 0.0;
        const Vec2 p(at * face.left_axis.x(), -at * face.left_axis.y());
        return image.x() + (p.x() - image.x()) * image.y() / (image.y() - p.y());
    };
    Window child{image.x(), image.y(), w.weight, 0, 0, 0, 0, w.error};
    child.begin = std::max(seen_at(w.begin), 0.0);
    child.end = to == ray ? length : std::min(seen_at(to), length);
    if (!(child.end - child.begin > negligible * length)) return;
    child.at_begin = w.weight + (image - Vec2(child.begin, 0)).norm();
    if (face.apex_bound + length - child.begin < child.at_begin) return;
    const Vec2 head(face.length * face.left_axis.x(), -face.length * face.left_axis.y());
    if (face.head_bound + (head - Vec2(child.begin, 0)).norm() < child.at_begin) return;
    child.at_end = to == ray && at_apex < infinity
                       ? at_apex
                       : w.weight + (image - Vec2(child.end, 0)).norm();
    if (face.tail_bound + child.end < child.at_end) return;
    send(face.to_left, child);
}

}  // namespace agvd
