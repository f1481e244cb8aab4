// A beam passes a face as a window does (see window.h): the ray to the apex divides it, and a part
// is dropped if paths by the ends of its edge, or by the corner behind, are shorter. Beams are not
// cut where others are shorter, as the bounds drop them within a few faces from there. In runs with
// errors a beam becomes a window as soon as its error allows, and is merged with others then.
#include <algorithm>
#include <cmath>
#include <optional>

#include "agvd/propagation/window/window_front.h"

namespace agvd {
namespace {

// Real meshes stay far below. Around a spike whose width is a rounding of its length beams would
// circle without end.
Index most_beams(const WindowFront& front) {
    constexpr Index least = 1 << 16, of_a_face = 256;
    return std::max(least, of_a_face * std::min(front.surface.num_faces(), no_index / of_a_face));
}

// Whether no path by an end of the half-edge is shorter on the whole interval.
bool is_open(const Beam& beam, double tail_bound, double head_bound, double length) {
    const double at = meeting_point(tail_bound, head_bound, length, beam.begin, beam.end);
    const double around = std::min(tail_bound + at, head_bound + length - at);
    return around + path_rounding * (around + length) >= beam.distance(at);
}

// The window of a beam, with an image that is far, but loses few digits. Its distances lie below
// the beam's, at the ends of the interval by a rounding. An image at distance D sees a beam of the
// width w open by angles of w / 2D. So in the middle of the beam distances are lower by w^2 / 8D at
// most; beside it paths bend at an end of the interval, by no more than the angle, and are longer
// than straight ones by w^2 / 8D at most. No window if both together are no small share of the
// error allowed.
std::optional<Window> to_window(const Beam& beam, double max_error) {
    constexpr double farthest = 1e4;  // As in merge_windows().
    constexpr double share = 1.0 / 16;
    const double nearest = beam.nearest();
    if (!(nearest > 0)) return std::nullopt;  // Rounding may turn 0 into less.
    const double away = farthest * nearest;
    const double width = beam.width();
    constexpr float round_up = 1 + 0x1p-20F;
    const auto error = static_cast<float>(width * width / (4 * away)) * round_up;
    if (!(error <= share * max_error * nearest)) return std::nullopt;
    const double middle = (beam.begin + beam.end) / 2;
    Window window{
        middle + away * beam.x, away * beam.y, 0, beam.begin, beam.end, 0, 0, error, false};
    const auto run_to = [&](double at) {
        return std::sqrt((at - window.x) * (at - window.x) + window.y * window.y);
    };
    const double to_begin = run_to(beam.begin);
    const double to_end = run_to(beam.end);
    window.weight =
        std::min(beam.distance(beam.begin) - to_begin, beam.distance(beam.end) - to_end);
    window.at_begin = window.weight + to_begin;
    window.at_end = window.weight + to_end;
    return window;
}

void send_beam(WindowFront& front, const Beam& beam) {
    if (front.max_error > 0) {
        if (const auto window = to_window(beam, front.max_error)) {
            front.relative_error = std::max(front.relative_error, window->error / beam.nearest());
            send(front, {beam.half_edge, beam.tail, beam.head}, *window);
            return;
        }
    }
    const Index record = front.beams.add(beam);
    Index bucket = no_index;
    front.queue.push(FrontItem::beam(record), beam.nearest(), bucket);
}

// A side of a face through which beams leave, in the frame beyond it.
struct Exit {
    HalfEdgeEnds to;
    double length;
    Vec2 axis, origin;              // Of the frame beyond, in the frame of the base.
    double tail_bound, head_bound;  // Of the exit's ends.
    double corner, corner_bound;    // The corner behind: on the base, and its bound.
    bool is_corner_at_tail;         // Of the base.
};

Exit right_exit(const WindowFace& face, const Beam& ends) {
    return {{face.next.twin, face.apex_record, ends.head},
            face.next.length,
            {face.right_x, face.right_y},
            {face.apex_x, face.apex_y},
            face.apex_bound,
            face.head_bound,
            0,
            face.tail_bound,
            true};
}

Exit left_exit(const WindowFace& face, const Beam& ends) {
    return {{face.previous.twin, ends.tail, face.apex_record},
            face.previous.length,
            {face.left_x, face.left_y},
            {0, 0},
            face.tail_bound,
            face.apex_bound,
            face.length,
            face.head_bound,
            false};
}

// The part of a beam from ray to ray.
struct BeamPart {
    double begin, end;
    bool is_from_tail, is_to_head;  // Whether these rays lead to the ends of the exit.
};

void pass_beam(WindowFront& front, const Beam& beam, const BeamPart& part, const Exit& exit) {
    if (exit.to.half_edge == no_index) return;
    const auto beyond = [&](double at) { return into(exit.axis, Vec2(at, 0) - exit.origin); };
    const Vec2 u = into(exit.axis, {beam.x, beam.y});
    if (!(u.y() < 0)) return;
    const auto seen_at = [&](double at) {
        const Vec2 p = beyond(at);
        return std::clamp(p.x() - p.y() * u.x() / u.y(), 0.0, exit.length);
    };
    const Beam child{u.x(),
                     u.y(),
                     beam.weight - exit.origin.x() * beam.x - exit.origin.y() * beam.y,
                     part.is_from_tail ? 0 : seen_at(part.begin),
                     part.is_to_head ? exit.length : seen_at(part.end),
                     exit.to.half_edge,
                     exit.to.tail,
                     exit.to.head};
    if (!(child.width() > negligible_beam * exit.length)) return;
    if (!is_open(child, exit.tail_bound, exit.head_bound, exit.length)) return;
    const double far_end = exit.is_corner_at_tail ? child.end : child.begin;
    const double around = exit.corner_bound + (beyond(exit.corner) - Vec2(far_end, 0)).norm();
    if (around + path_rounding * (around + exit.length) < child.distance(far_end)) return;
    send_beam(front, child);
}

// Reaches the apex of the face; returns where the ray to it crosses the base.
double reach_apex_by_beam(WindowFront& front, const Beam& beam, const WindowFace& face) {
    const double ray = face.apex_x - face.apex_y * beam.x / beam.y;
    const double slack = grazing * face.length;
    if (ray < beam.begin - slack || ray > beam.end + slack) {
        const double bend = ray < beam.begin ? beam.begin : beam.end;
        const Vec2 rest(face.apex_x - bend, face.apex_y);
        front.vertices.lower_bound(face.apex_record, beam.distance(bend) + rest.norm());
    } else {
        const double at_apex = beam.weight - face.apex_x * beam.x - face.apex_y * beam.y;
        reach_vertex(front, face.apex_record,
                     {at_apex, 0, Surface::previous(face.half_edge),
                      into(Vec2(-face.left_x, -face.left_y), {beam.x, beam.y})});
    }
    return ray;
}

}  // namespace

void emit_beam(WindowFront& front, Index side, double start) {
    send_beam(front, {0, -1, start, 0, front.corners.length(side), side,
                      vertex_record(front, front.corners.tail(side)),
                      vertex_record(front, front.corners.head(side))});
}

void serve_beam(WindowFront& front, Index record) {
    const Beam beam = front.beams.records[record];
    WindowFace face(front.corners, beam.half_edge);
    face.tail_bound = front.vertices.records[beam.tail].bound;
    face.head_bound = front.vertices.records[beam.head].bound;
    const bool lives = is_open(beam, face.tail_bound, face.head_bound, face.length);
    if (!lives || (front.keeps != nullptr && !(*front.keeps)(Surface::face(beam.half_edge)))) {
        front.beams.give_back(record);
    }
    if (!lives) return;
    if (front.beams.num_served++ > most_beams(front)) {
        front.relative_error = infinity;
        return;
    }
    front.ticker.tick();
    ++front.num_served;
    face.apex_record = vertex_record(front, face.previous.tail);
    const double ray = reach_apex_by_beam(front, beam, face);
    face.apex_bound = front.vertices.records[face.apex_record].bound;
    const bool is_at_tail = beam.begin == 0, is_at_head = beam.end == face.length;
    const bool is_divided = beam.begin < ray && ray < beam.end;
    if (ray < beam.end) {
        pass_beam(front, beam, {is_divided ? ray : beam.begin, beam.end, is_divided, is_at_head},
                  right_exit(face, beam));
    }
    if (ray > beam.begin) {
        pass_beam(front, beam, {beam.begin, is_divided ? ray : beam.end, is_at_tail, is_divided},
                  left_exit(face, beam));
    }
}

}  // namespace agvd
