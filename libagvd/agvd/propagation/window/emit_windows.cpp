// Sends the first windows of a site, and those of pseudo-sources ([mitchell1987]). A pseudo-source
// emits windows only into its shadow: the directions that make at least pi with the arrival on both
// sides. Its sides are found by unfolding the faces around the vertex, without computing angles.
#include "agvd/propagation/window/emit_windows.h"

#include <algorithm>

#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/window/emit_fan.h"
#include "agvd/propagation/window/reach_vertex.h"
#include "agvd/propagation/window/send_windows.h"
#include "agvd/propagation/window/window_rays.h"

namespace agvd {
namespace {

// From a site in a face, or on its half-edge `skipped`, through the other edges of the face.
void emit_from_face(FrontState& front, const SurfacePoint& point, Index skipped) {
    const Surface& surface = front.input.surface;
    for (Index k = 0; k < 3; ++k) {
        const Index h = 3 * point.face.value() + k;
        const Vec2 p = position_in_frame(surface, point, h);
        reach_vertex(front, vertex_record(front, surface.tail(h)), {p.norm(), 0, h, p});
        if (h == skipped || surface.twin[h] == no_index) continue;
        const double length = surface.length_of(h);
        const Vec2 image(length - p.x(), -p.y());
        if (!(image.y() < 0)) continue;
        const Window window{
            image.x(), image.y(), 0, 0, length, image.norm(), (image - Vec2(length, 0)).norm(),
            0,         false};
        const Index tail = vertex_record(front, surface.head(h));
        send(front, {surface.twin[h], tail, vertex_record(front, surface.tail(h))}, window);
    }
}

// Beside a vertex rounding may leave gaps between the faces that the site sees: one or two of ten
// thousand such sites. What leaves through the vertex fills them, and dies elsewhere.
void emit_from_near_vertices(FrontState& front, const SurfacePoint& site) {
    const Surface& surface = front.input.surface;
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

}  // namespace

void emit_from_site(FrontState& front, const SurfacePoint& site) {
    const Surface& surface = front.input.surface;
    if (const auto vertex = vertex_of(surface, site)) {
        const Index record = vertex_record(front, *vertex);
        VertexRecord& v = front.vertices.records[record];
        v.low = v.upper = v.bound = 0;
        if (surface.outgoing[*vertex] != no_index) (void)emit_fan(front, fan_around(front, record));
        return;
    }
    const auto half_edge = half_edge_of(site);
    emit_from_face(front, site, half_edge.value_or(no_index));
    if (half_edge && surface.twin[*half_edge] != no_index) {
        emit_from_face(front, across_edge(surface, site, *half_edge), surface.twin[*half_edge]);
    }
    emit_from_near_vertices(front, site);
}

void emit_from_pseudo_source(FrontState& front, const PseudoSource& source) {
    const VertexRecord& v = front.vertices.records[source.vertex];
    if (!(source.distance <= v.bound * (1 + grazing))) return;
    if (front.input.max_error == 0 && source.distance > v.low) return;
    Fan fan = fan_around(front, source.vertex);
    if (source.half_edge == no_index) {
        (void)emit_fan(front, fan);
        return;
    }
    const Index vertex = v.vertex;
    const Index outgoing = fan.first;
    const ShadowSide right = right_side_of_shadow(front.input.corners, source);
    const ShadowSide left = left_side_of_shadow(front.input.corners, source);
    fan.last = left.half_edge;
    fan.to = left.ray;
    if (right.half_edge != no_index) {
        fan.first = right.half_edge;
        fan.from = right.ray;
        if (emit_fan(front, fan)) return;
    }
    if (left.half_edge == no_index) return;
    // The part behind the boundary. Whether the vertex lies on it is asked last: seldom in the
    // cache.
    fan.first = front.input.surface.is_boundary_vertex(vertex) ? outgoing : left.half_edge;
    fan.from = std::nullopt;
    (void)emit_fan(front, fan);
}

}  // namespace agvd
