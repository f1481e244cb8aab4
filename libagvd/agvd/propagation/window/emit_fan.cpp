#include "agvd/propagation/window/emit_fan.h"

#include <algorithm>

#include "agvd/propagation/window/reach_vertex.h"
#include "agvd/propagation/window/send_windows.h"
#include "agvd/propagation/window/window_rays.h"

namespace agvd {
namespace {

struct Interval {
    double begin, end;
};

// The face at the tail of a half-edge, seen from beyond the opposite edge: that frame starts at the
// apex of the half-edge and runs clockwise around the vertex.
struct FanFace {
    FanFace(const Corners& corners, Index leaving)
        : half_edge(leaving),
          first(corners[leaving]),
          opposite(corners[Surface::next(leaving)]),
          last(corners[Surface::previous(leaving)]),
          vertex(corners.apex(Surface::next(leaving))),
          image(opposite.length - vertex.x(), -vertex.y()),
          axis((Vec2(first.length, 0) - corners.apex(leaving)) / opposite.length) {}

    Index half_edge;
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

// The part of the opposite edge that the fan sees. The fan lies to the left of `from`: nearer the
// apex.
Interval visible_part(const FanFace& face, const Fan& fan) {
    const double length = face.opposite.length;
    const double slack = grazing * length;
    const bool has_from = face.half_edge == fan.first && fan.from.has_value();
    const bool has_to = face.half_edge == fan.last && fan.to.has_value();
    return {has_to ? std::max(face.meets_at(*fan.to) - slack, 0.0) : 0,
            has_from ? std::min(face.meets_at(*fan.from) + slack, length) : length};
}

void emit_into(FrontState& front, Index half_edge, const Fan& fan) {
    const FanFace face(front.input.corners, half_edge);
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
    const auto [begin, end] = visible_part(face, fan);
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

}  // namespace

Fan fan_around(const FrontState& front, Index record) {
    constexpr double round_up = 1 + 1e-6;
    const VertexRecord& v = front.vertices.records[record];
    return {v.low, static_cast<float>(std::max(v.upper - v.low, 0.0) * round_up),
            front.input.surface.outgoing[v.vertex]};
}

bool emit_fan(FrontState& front, const Fan& fan) {
    Index h = fan.first;
    do {
        emit_into(front, h, fan);
        if (h == fan.last) return true;
        h = front.input.corners.twin(Surface::previous(h));
    } while (h != no_index && h != fan.first);
    return h != no_index;
}

}  // namespace agvd
