// In front of an edge of a line the shortest paths are parallel and make right angles with it; from
// a vertex they fill the angle between the beams of its edges, if there is one. A sector is what
// lies around a vertex between two edges of lines, or between one and the boundary; where it is
// wider than pi (pi / 2 at the boundary), a fan leaves between the right angles.
#include <algorithm>
#include <optional>

#include "agvd/propagation/window/window_front.h"

namespace agvd {
namespace {

// A fan narrower than this (sine of its angle) is rounding.
constexpr double narrow_fan = 1e-9;

// A face around a vertex, and a ray from the vertex in the frame of the half-edge.
struct FaceRay {
    Index half_edge;  // Leaves the vertex.
    Vec2 ray;
};

// The faces around the vertices of a shape, off the shape.
struct Around {
    const Corners& corners;
    const ShapeSource& shape;

    [[nodiscard]] bool is_side(Index h) const { return is_among(shape.sides, h); }
    // The next half-edge around the tail; no_index: at the end of the sector.
    [[nodiscard]] Index left(Index h) const {
        const Index previous = Surface::previous(h);
        return is_side(previous) ? no_index : corners.twin(previous);
    }
    [[nodiscard]] Index right(Index h) const {
        const Index twin = is_side(h) ? no_index : corners.twin(h);
        return twin == no_index ? no_index : Surface::next(twin);
    }
};

// The ray at a right angle, counter-clockwise, from the half-edge at which a sector begins.
std::optional<FaceRay> right_angle_after(const Around& around, Index first) {
    FaceRay at{first, {0, 1}};
    while (true) {
        const Vec2 turned = into(around.corners[at.half_edge].turn, at.ray);
        if (turned.y() <= 0) return at;
        const Index next = around.left(at.half_edge);
        if (next == no_index) return std::nullopt;
        at = {next, turned};
    }
}

// The same clockwise from the edge at which a sector ends, behind the face of the half-edge `last`.
std::optional<FaceRay> right_angle_before(const Around& around, Index last) {
    const Vec2& end = around.corners[last].turn;
    FaceRay at{last, {end.y(), -end.x()}};
    while (!(at.ray.y() > 0)) {
        const Index next = around.right(at.half_edge);
        if (next == no_index) return std::nullopt;
        const Vec2& corner = around.corners[next].turn;
        at = {next, into({corner.x(), -corner.y()}, at.ray)};
    }
    return at;
}

// Whether a ray lies behind another one counter-clockwise, by more than rounding, in one sector.
bool is_behind(const Around& around, const FaceRay& later, const FaceRay& earlier) {
    FaceRay at = earlier;
    bool is_first = true;
    while (at.half_edge != later.half_edge) {
        const Index next = around.left(at.half_edge);
        if (next == no_index) return false;
        at = {next, is_first ? into(around.corners[at.half_edge].turn, at.ray) : Vec2(0, 0)};
        is_first = false;
    }
    if (at.ray == Vec2(0, 0)) return true;  // A whole face lies between.
    const double angle = cross(at.ray, later.ray);
    return angle > narrow_fan * at.ray.norm() * later.ray.norm() || at.ray.dot(later.ray) < 0;
}

// Whether a half-edge at which a sector ends belongs to a line or region, not to the boundary only.
bool is_of_shape(const WindowFront& front, const Around& around, Index half_edge) {
    return front.surface.twin[half_edge] != no_index || around.is_side(half_edge);
}

// Emits into the sector that begins at a side.
void emit_left_of_tail(WindowFront& front, const Around& around, Index side) {
    const std::optional<FaceRay> from = right_angle_after(around, side);
    if (!from) return;
    Index last = from->half_edge;
    for (Index next = last; next != no_index; next = around.left(next)) last = next;
    Fan fan{around.shape.start, 0, from->half_edge, last, from->ray};
    if (is_of_shape(front, around, Surface::previous(last))) {
        const std::optional<FaceRay> to = right_angle_before(around, last);
        if (!to || !is_behind(around, *to, *from)) return;
        fan.last = to->half_edge;
        fan.to = to->ray;
    }
    (void)emit_fan(front, fan);
}

// Emits into the sector that ends at a side, if it begins at the boundary.
void emit_right_of_head(WindowFront& front, const Around& around, Index side) {
    const std::optional<FaceRay> to = right_angle_before(around, Surface::next(side));
    if (!to) return;
    Index first = to->half_edge;
    for (Index next = first; next != no_index; next = around.right(next)) first = next;
    if (is_of_shape(front, around, first)) return;
    (void)emit_fan(front, {around.shape.start, 0, first, to->half_edge, {}, to->ray});
}

}  // namespace

void emit_from_shape(WindowFront& front, const ShapeSource& shape) {
    for (const Index vertex : shape.vertices) {
        VertexRecord& v = front.vertices.records[vertex_record(front, vertex)];
        v.low = v.upper = shape.start;
        v.bound = std::min(v.bound, shape.start);
    }
    const Around around{front.corners, shape};
    const auto is_own = [&](Index vertex) { return is_among(shape.own_vertices, vertex); };
    for (const Index side : shape.sector_sides) {
        if (is_among(shape.own_sides, side)) emit_beam(front, side, shape.start);
        if (is_own(front.surface.tail(side))) emit_left_of_tail(front, around, side);
        if (is_own(front.surface.head(side))) emit_right_of_head(front, around, side);
    }
}

}  // namespace agvd
