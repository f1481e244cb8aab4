// Sources: [mitchell1987] windows, [chen1990] one angle, one split, [xin2009] filters. Here,
// windows die by bounds that all sites share, and half-edges are served with all their windows at
// once.
//
// A half-edge may be closed if all that could still come there would be beaten by the bounds of its
// ends: paths to come are no shorter than the current bucket, but for errors, of which more than
// one is allowed for, and no point of it is farther than half the way around both ends. No result
// changes by that.
#include "agvd/propagation/window/window_front.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "agvd/propagation/site_placement.h"

namespace agvd {

namespace {

// Arrivals within each other's error may send windows back and forth between vertices. After so
// many pseudo-sources a vertex emits its whole fan, which holds what any further one would.
constexpr Index max_pseudo_sources = 32;

// The face at the tail of a half-edge, seen from beyond the opposite edge: that frame starts at the
// apex of the half-edge and runs clockwise around the vertex.
struct FanFace {
    FanFace(const Corners& corners, Index leaving)
        : first(corners[leaving]),
          opposite(corners[Surface::next(leaving)]),
          last(corners[Surface::previous(leaving)]),
          vertex(corners.apex(Surface::next(leaving))),
          image(opposite.length - vertex.x(), -vertex.y()),
          axis((Vec2(first.length, 0) - corners.apex(leaving)) / opposite.length) {}

    const Corner& first;
    const Corner& opposite;
    const Corner& last;
    Vec2 vertex;  // In the frame of the opposite half-edge.
    Vec2 image;   // The same in the frame beyond.
    Vec2 axis;    // Of the frame beyond, in the frame of the half-edge.

    // Where a ray in the frame of the half-edge crosses the opposite edge.
    [[nodiscard]] double meets_at(const Vec2& ray) const {
        const Vec2 direction = into(axis, ray);
        if (direction.y() > 0) return image.x() - image.y() * direction.x() / direction.y();
        return direction.x() > 0 ? infinity : -infinity;
    }
};

void emit_into(WindowFront& front, Index half_edge, const Fan& fan) {
    const FanFace face(front.corners, half_edge);
    const double length = face.opposite.length;
    const Window window{face.image.x(),
                        face.image.y(),
                        fan.distance,
                        0,
                        length,
                        fan.distance + face.last.length,
                        fan.distance + face.first.length,
                        fan.error,
                        false};
    // The part that the fan sees. It lies to the left of `from`: nearer the apex.
    const double slack = grazing * length;
    const double begin = half_edge == fan.last && fan.to.has_value()
                             ? std::max(face.meets_at(*fan.to) - slack, 0.0)
                             : 0;
    const double end = half_edge == fan.first && fan.from.has_value()
                           ? std::min(face.meets_at(*fan.from) + slack, length)
                           : length;
    const Index head = vertex_record(front, face.opposite.tail);
    const Index apex = vertex_record(front, face.last.tail);
    if (end == length) {
        reach_vertex(front, head,
                     {window.at_end, fan.error, Surface::next(half_edge), face.vertex});
    } else {
        front.vertices.lower_bound(head, window.at_end + fan.error);
    }
    if (begin == 0) {
        reach_vertex(
            front, apex,
            {window.at_begin, fan.error, Surface::previous(half_edge), Vec2(face.last.length, 0)});
    } else {
        front.vertices.lower_bound(apex, window.at_begin + fan.error);
    }
    if (face.opposite.twin == no_index || !(begin < end)) return;
    send(front, {face.opposite.twin, apex, head}, window.part(begin, end));
}

// All directions at a vertex of a run.
Fan fan_around(const WindowFront& front, Index record) {
    constexpr double round_up = 1 + 1e-6;
    const VertexRecord& v = front.vertices.records[record];
    return {v.low, static_cast<float>(std::max(v.upper - v.low, 0.0) * round_up),
            front.surface.outgoing[v.vertex]};
}

// From a site in a face, or on its half-edge `skipped`, through the other edges of the face.
void emit_from_face(WindowFront& front, const SurfacePoint& point, Index skipped, double start) {
    const Surface& surface = front.surface;
    for (Index h = 3 * point.face.value(); h < 3 * point.face.value() + 3; ++h) {
        const Vec2 p = position_in_frame(surface, point, h);
        reach_vertex(front, vertex_record(front, surface.tail(h)), {start + p.norm(), 0, h, p});
        const Index twin = front.corners.twin(h);
        if (h == skipped || twin == no_index) continue;
        const double length = surface.length_of(h);
        const Vec2 image(length - p.x(), -p.y());
        if (!(image.y() < 0)) continue;
        const Window window{image.x(),
                            image.y(),
                            start,
                            0,
                            length,
                            start + image.norm(),
                            start + (image - Vec2(length, 0)).norm(),
                            0,
                            false};
        const Index tail = vertex_record(front, surface.head(h));
        send(front, {twin, tail, vertex_record(front, surface.tail(h))}, window);
    }
}

// Beside a vertex rounding may leave gaps between the faces that the site sees: one or two of ten
// thousand such sites. What leaves through the vertex fills them, and dies elsewhere.
void emit_from_near_vertices(WindowFront& front, const SurfacePoint& site) {
    const Surface& surface = front.surface;
    for (Index h = 3 * site.face.value(); h < 3 * site.face.value() + 3; ++h) {
        const double distance = position_in_frame(surface, site, h).norm();
        const double shorter =
            std::min(surface.length_of(h), surface.length_of(Surface::previous(h)));
        if (distance > near_vertex * shorter) continue;
        (void)emit_fan(front, fan_around(front, vertex_record(front, surface.tail(h))));
    }
}

// Where the shadow of a pseudo-source begins or ends.
struct ShadowSide {
    Index half_edge;  // Leaves the vertex, into the face that holds the ray; no_index: none does.
    Vec2 ray;         // The way straight on, in the frame of the half-edge.
};

// Counter-clockwise from the arrival. In the frame of each next half-edge the arrival turns
// clockwise, and has turned by pi where it comes up again.
ShadowSide right_side_of_shadow(const Corners& corners, const PseudoSource& source) {
    ShadowSide side{no_index, {source.arrival_x, source.arrival_y}};
    for (Index h = source.half_edge; h != no_index;) {
        const Vec2 turned = into(corners[h].turn, side.ray);
        if (h != source.half_edge && side.ray.y() <= 0 && turned.y() > 0) {
            side.half_edge = h;
            break;
        }
        side.ray = turned;
        h = corners.twin(Surface::previous(h));
        if (h == source.half_edge) break;
    }
    side.ray = -side.ray;
    return side;
}

// The same clockwise from the arrival.
ShadowSide left_side_of_shadow(const Corners& corners, const PseudoSource& source) {
    ShadowSide side{no_index, {source.arrival_x, source.arrival_y}};
    for (Index twin = corners[source.half_edge].twin; twin != no_index;) {
        const Index h = Surface::next(twin);
        if (h == source.half_edge) break;
        const Vec2& corner = corners[h].turn;
        const Vec2 turned(corner.x() * side.ray.x() - corner.y() * side.ray.y(),
                          corner.x() * side.ray.y() + corner.y() * side.ray.x());
        const bool is_behind = side.ray.y() >= 0 && turned.y() < 0;
        side.ray = turned;
        if (is_behind) {
            side.half_edge = h;
            break;
        }
        twin = corners[h].twin;
    }
    side.ray = -side.ray;
    return side;
}

void close_or_watch(WindowFront& front, Index record) {
    EdgeRecord& edge = front.edges.records[record];
    assert(edge.half_edge != no_index);
    const auto& vertices = front.vertices.records;
    const double around = vertices[edge.tail].bound + vertices[edge.head].bound +
                          front.corners.length(edge.half_edge);
    const double slack = (1 + front.max_error) * (1 + front.max_error) * (1 + front.max_error);
    const double farthest = around / 2 * (slack * (1 + 1e-9));
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

// Loads what an item needs after its corners, and what is seldom in the cache.
[[gnu::always_inline]] inline void prefetch(const WindowFront& front, FrontItem item) {
    if (!item.is_half_edge()) return;
    const EdgeRecord& edge = front.edges.records[item.record()];
    if (edge.waiting != no_index) front.store.prefetch(edge.waiting);
    const Corners& corners = front.corners;
    const Corner& next = corners[Surface::next(edge.half_edge)];
    const Corner& previous = corners[Surface::previous(edge.half_edge)];
    __builtin_prefetch(&front.vertices.record_of[previous.tail]);
    __builtin_prefetch(&front.bounds[previous.tail]);
    if (next.twin != no_index) __builtin_prefetch(&front.edges.record_of[next.twin]);
    if (previous.twin != no_index) __builtin_prefetch(&front.edges.record_of[previous.twin]);
}

// Sends windows from the site into all directions.
void emit_from_site(WindowFront& front, const SurfacePoint& site, double start) {
    const Surface& surface = front.surface;
    if (const auto vertex = vertex_of(surface, site)) {
        const Index record = vertex_record(front, *vertex);
        VertexRecord& v = front.vertices.records[record];
        if (start > v.outer_bound) return;  // Others are nearer.
        v.low = v.upper = v.bound = start;
        if (surface.outgoing[*vertex] != no_index) (void)emit_fan(front, fan_around(front, record));
        return;
    }
    for_each_side(surface, site, [&](const SurfacePoint& point, Index half_edge) {
        emit_from_face(front, point, half_edge, start);
    });
    emit_from_near_vertices(front, site);
}

// Sends windows into the shadow behind a saddle or boundary vertex: the directions that make an
// angle of pi or more with the arrival on both sides.
void emit_from_pseudo_source(WindowFront& front, const PseudoSource& source) {
    const VertexRecord& v = front.vertices.records[source.vertex];
    if (!(source.distance <= v.bound * (1 + grazing))) return;
    if (front.max_error == 0 && source.distance > v.low) return;
    Fan fan = fan_around(front, source.vertex);
    if (source.half_edge == no_index) {
        (void)emit_fan(front, fan);
        return;
    }
    const Index vertex = v.vertex;
    const Index outgoing = fan.first;
    const ShadowSide right = right_side_of_shadow(front.corners, source);
    const ShadowSide left = left_side_of_shadow(front.corners, source);
    fan.last = left.half_edge;
    fan.to = left.ray;
    if (right.half_edge != no_index) {
        fan.first = right.half_edge;
        fan.from = right.ray;
        if (emit_fan(front, fan)) return;
    }
    if (left.half_edge == no_index) return;
    // The part behind the boundary; asked last, as it is seldom in the cache.
    fan.first = front.surface.is_boundary_vertex(vertex) ? outgoing : left.half_edge;
    fan.from = std::nullopt;
    (void)emit_fan(front, fan);
}

// False if the cap was passed; what the front then holds means nothing.
template <typename Emit>
bool run_in_order(WindowFront& front, WindowQueue::Order order, const Emit& emit, double start,
                  Index work_cap) {
    front.reset(order, start);
    emit();
    while (!front.queue.empty()) {
        const FrontItem item = front.queue.pop([&](FrontItem next) { prefetch(front, next); });
        close_edges(front);
        const Index record = item.record();
        if (!item.is_half_edge()) {
            if (item.is_beam()) {
                serve_beam(front, record);
            } else {
                emit_from_pseudo_source(front, front.pseudo_sources.take(record));
            }
        } else if (front.queue.take(front.edges.records[record].bucket)) {
            serve_edge(front, record);
            if (front.edges.records[record].num_served > work_cap) return false;
        }
    }
    return true;
}

template <typename Emit>
void run_both_orders(WindowFront& front, const Emit& emit, double start,
                     std::span<const float> bounds, Index work_cap, const KeptFaces& keeps) {
    using enum WindowQueue::Order;
    front.bounds = bounds;
    front.keeps = keeps ? &keeps : nullptr;
    if (!run_in_order(front, Buckets, emit, start, work_cap)) {
        (void)run_in_order(front, Nearest, emit, start, no_index);
    }
    front.keeps = nullptr;
}

}  // namespace

bool emit_fan(WindowFront& front, const Fan& fan) {
    Index h = fan.first;
    do {
        emit_into(front, h, fan);
        if (h == fan.last) return true;
        h = front.corners.twin(Surface::previous(h));
    } while (h != no_index && h != fan.first);
    return h != no_index;
}

void reach_vertex(WindowFront& front, Index record, const Arrival& arrival) {
    const double distance = arrival.distance;
    front.vertices.lower_bound(record, distance + arrival.error);
    VertexRecord& v = front.vertices.records[record];
    const bool is_nearest = distance < v.low;
    if (is_nearest) v.low = distance;
    if (front.surface.can_be_pseudo_source[v.vertex] == 0) return;
    if (!(distance <= v.bound * (1 + grazing))) return;
    // Of exact arrivals the nearest tells where the shadow lies; of others any may.
    if (!is_nearest && (front.max_error == 0 || distance == v.last_arrival)) return;
    v.last_arrival = distance;
    Index half_edge = arrival.half_edge;
    if (++v.num_pseudo_sources > max_pseudo_sources) {
        if (v.num_pseudo_sources > max_pseudo_sources + 1 && !is_nearest) return;
        half_edge = no_index;
    }
    const Index source = front.pseudo_sources.add(
        {record, half_edge, arrival.direction.x(), arrival.direction.y(), distance});
    Index bucket = no_index;
    front.queue.push(FrontItem::pseudo_source(source), distance, bucket);
}

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

void run_front(WindowFront& front, const SurfacePoint& site, std::span<const float> bounds,
               Index work_cap, const KeptFaces& keeps, double start) {
    run_both_orders(
        front, [&] { emit_from_site(front, site, start); }, start, bounds, work_cap, keeps);
}

void run_front(WindowFront& front, const ShapeSource& shape, std::span<const float> bounds,
               Index work_cap, const KeptFaces& keeps) {
    run_both_orders(
        front, [&] { emit_from_shape(front, shape); }, shape.start, bounds, work_cap, keeps);
}

}  // namespace agvd
