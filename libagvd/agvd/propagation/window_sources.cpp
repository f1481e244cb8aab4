// Where windows start: at sites, and at the vertices around which paths may bend.

#include <algorithm>

#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/window_front.h"
#include "agvd/propagation/window_rays.h"

namespace agvd {

void WindowFront::start(const SurfacePoint& site) {
    if (const auto vertex = vertex_of(surface_, site)) {
        const Index record = vertex_record(*vertex);
        VertexRecord& v = vertices_[record];
        v.low = v.upper = v.bound = 0;
        const Index first = surface_.outgoing[*vertex];
        if (first != no_index) emit_fan(first, nullptr, no_index, nullptr, VertexRecord(v));
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
            if (!(image.y() < 0)) continue;
            const Window window{
                image.x(), image.y(), 0, 0, length, image.norm(), (image - Vec2(length, 0)).norm(),
                0,         false};
            send(surface_.twin[h], vertex_record(surface_.head(h)), vertex_record(surface_.tail(h)),
                 window);
        }
    };
    const auto half_edge = half_edge_of(site);
    spread(site, half_edge.value_or(no_index));
    if (half_edge && surface_.twin[*half_edge] != no_index) {
        spread(across_edge(surface_, site, *half_edge), surface_.twin[*half_edge]);
    }
    // Beside a vertex rounding may leave gaps between the faces that the site sees: one or two of
    // ten thousand such sites. What leaves through the vertex fills them, and dies elsewhere.
    for (Index h = 3 * site.face.value(); h < 3 * site.face.value() + 3; ++h) {
        const double distance = position_in_frame(surface_, site, h).norm();
        const double shorter =
            std::min(surface_.length_of(h), surface_.length_of(Surface::previous(h)));
        if (distance > beside_vertex * shorter) continue;
        const VertexRecord v = vertices_[vertex_record(surface_.tail(h))];
        emit_fan(surface_.outgoing[v.vertex], nullptr, no_index, nullptr, v);
    }
}

// Windows from the tail of `half_edge` onto the opposite edge of its face; `from` and `to`, if
// given, are rays that bound the fan, in the frame of the half-edge.
void WindowFront::emit_into(Index half_edge, double weight, float error, const Vec2* from,
                            const Vec2* to) {
    const Corner& first = corners_[half_edge];
    const Corner& opposite = corners_[Surface::next(half_edge)];
    const Corner& last = corners_[Surface::previous(half_edge)];
    const Vec2 vertex = corners_.apex(Surface::next(half_edge));
    const double length = opposite.length;
    // The frame beyond starts at the apex of `half_edge` and runs clockwise around the vertex.
    const Vec2 image(length - vertex.x(), -vertex.y());
    Window window{
        image.x(), image.y(), weight, 0, length, weight + last.length, weight + first.length,
        error,     false};
    const Vec2 axis = (Vec2(first.length, 0) - corners_.apex(half_edge)) / length;
    const auto meets_at = [&](const Vec2& ray) {
        const Vec2 direction = into(axis, ray);
        if (direction.y() > 0) return image.x() - image.y() * direction.x() / direction.y();
        return direction.x() > 0 ? infinity : -infinity;
    };
    // The fan lies to the left of `from`: nearer the apex.
    const double slack = grazing * length;
    const double end = from ? std::min(meets_at(*from) + slack, length) : length;
    const double begin = to ? std::max(meets_at(*to) - slack, 0.0) : 0;

    const Index head = vertex_record(opposite.tail);
    const Index apex = vertex_record(last.tail);
    if (end == length) {
        reach_vertex(head, window.at_end, error, Surface::next(half_edge), vertex);
    } else {
        bound_vertex(head, window.at_end + error);
    }
    if (begin == 0) {
        reach_vertex(apex, window.at_begin, error, Surface::previous(half_edge), {last.length, 0});
    } else {
        bound_vertex(apex, window.at_begin + error);
    }
    if (opposite.twin == no_index || !(begin < end)) return;
    window = window.part(begin, end);
    send(opposite.twin, apex, head, window);
}

// The shadow behind a saddle or boundary vertex: the directions that make an angle of pi or more
// with the arrival on both sides. Faces are unfolded around the vertex one after the other.
void WindowFront::emit(const PseudoSource& source) {
    const VertexRecord v = vertices_[source.vertex];
    if (!(source.distance <= v.bound * (1 + grazing))) return;
    if (max_error_ == 0 && source.distance > v.low) return;
    if (source.half_edge == no_index) {
        emit_fan(surface_.outgoing[v.vertex], nullptr, no_index, nullptr, v);
        return;
    }

    // Counter-clockwise: the arrival in the frame of each next half-edge turns clockwise, and has
    // turned by pi where it comes up again.
    Index first = no_index;
    Vec2 from(source.arrival_x, source.arrival_y);
    for (Index h = source.half_edge; h != no_index;) {
        const Vec2 turned = into(corners_[h].turn, from);
        if (h != source.half_edge && from.y() <= 0 && turned.y() > 0) {
            first = h;
            break;
        }
        from = turned;
        h = corners_.twin(Surface::previous(h));
        if (h == source.half_edge) break;
    }
    // Clockwise, the other way round.
    Index last = no_index;
    Vec2 to(source.arrival_x, source.arrival_y);
    for (Index twin = corners_[source.half_edge].twin; twin != no_index;) {
        const Index h = Surface::next(twin);
        if (h == source.half_edge) break;
        const Vec2& corner = corners_[h].turn;
        const Vec2 turned(corner.x() * to.x() - corner.y() * to.y(),
                          corner.x() * to.y() + corner.y() * to.x());
        const bool is_behind = to.y() >= 0 && turned.y() < 0;
        to = turned;
        if (is_behind) {
            last = h;
            break;
        }
        twin = corners_[h].twin;
    }
    from = -from;
    to = -to;
    // Whether the vertex lies on the boundary is asked last: seldom in the cache.
    if (first != no_index && emit_fan(first, &from, last, &to, v)) return;
    if (last == no_index) return;
    const bool is_boundary = surface_.is_boundary_vertex(v.vertex);
    emit_fan(is_boundary ? surface_.outgoing[v.vertex] : last, nullptr, last, &to, v);
}

// Counter-clockwise from one face to another, or to the boundary or all around. False if the
// boundary comes first.
bool WindowFront::emit_fan(Index first, const Vec2* from, Index last, const Vec2* to,
                           const VertexRecord& v) {
    const auto error = static_cast<float>(std::max(v.upper - v.low, 0.0) * (1 + 1e-6));
    Index h = first;
    do {
        emit_into(h, v.low, error, h == first ? from : nullptr, h == last ? to : nullptr);
        if (h == last) return true;
        h = corners_.twin(Surface::previous(h));
    } while (h != no_index && h != first);
    return h != no_index;
}

}  // namespace agvd
