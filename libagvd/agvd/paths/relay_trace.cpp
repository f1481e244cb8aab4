// At the point, the nearest relay of its faces tells the image to go to. The line to the image is
// followed from face to face until the image lies in one: there the next relay is asked. It is that
// of the site, or of a vertex where the path bends. At a vertex on the line all its faces are
// asked: the image is right on one side of it only, and rounding would choose the side. Relays with
// errors are asked in every face, since no site or vertex need lie at their images. Where parallel
// paths lead, the line ends at a side of their site.
#include "agvd/paths/relay_trace.h"

#include <algorithm>

#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

// A share of the lengths of a face: nearer to it, an image lies in it, and a line that is nearer to
// a corner passes through it.
constexpr double image_in_face = 1e-10;
// A share of a distance: pieces of a path that are shorter are rounding.
constexpr double no_piece = 1e-12;
// A share of a distance: a path with no more left ends at the side that it has come to.
constexpr double nothing_left = 1e-9;

// The relay that a path arrives through, and the face through which it comes.
struct Chosen {
    SurfacePoint view;  // The point, in this face.
    const Relay* relay = nullptr;
    Vec2 from;  // The start of the last straight piece, in the relay's frame.
    double distance = infinity;
};

// A line in the frame of a half-edge, from a point of its face to an image beyond it.
struct ImageLine {
    Index half_edge;
    Vec2 from, image;
};

class RelayTracer {
public:
    RelayTracer(const TracedField& field, const SurfacePoint& start, Ticker& ticker)
        : surface_(field.surface), field_(field), ticker_(ticker) {
        path_.points.push_back(start);
    }

    std::optional<TracedPath> run() {
        Chosen chosen = choose(path_.points.front(), 0);
        // Distances fall from piece to piece, but for errors and rounding: the end comes.
        for (std::size_t left = std::size_t{4} * surface_.num_faces() + 64; left > 0; --left) {
            if (chosen.relay == nullptr) return std::nullopt;
            if (ends_at_site(chosen)) return std::move(path_);
            chosen = chosen.relay->y >= 0 ? go_to_corner(chosen) : go_across(chosen);
            if (path_.site.is_valid()) return std::move(path_);
        }
        return std::nullopt;
    }

private:
    // The nearest relay at a point over all faces that hold it.
    // \param distance  of a point where the path has turned already: relays that start there do not
    //                  count, but for the site. 0: of any point.
    [[nodiscard]] Chosen choose(const SurfacePoint& point, double distance) {
        Chosen best;
        for_each_view(surface_, point, [&](const SurfacePoint& view) {
            choose_in_face(view, no_index, distance, best);
        });
        return best;
    }
    // \param entered  half-edge through which relays do not count: the path went out there.
    void choose_in_face(const SurfacePoint& view, Index entered, double distance, Chosen& best) {
        const Index face = view.face.value();
        const std::optional<Index> mixed = mixed_index_of(field_.propagation, face);
        if (!mixed) return;
        const std::array<Vec2, 3> seen{position_in_frame(surface_, view, 3 * face),
                                       position_in_frame(surface_, view, 3 * face + 1),
                                       position_in_frame(surface_, view, 3 * face + 2)};
        const auto relays = relays_of(field_.propagation, *mixed);
        ticker_.tick(relays.size());
        for (const Relay& relay : relays) {
            if (relay.half_edge == entered && relay.y < 0) continue;
            const Reach r = reach(to_planar(relay, Motion()), seen[relay.half_edge % 3]);
            if (!(r.distance < best.distance)) continue;
            const double rounding = no_piece * distance;
            if (r.last_piece < rounding && r.distance > rounding &&
                !field_.ends.of_relay(relay, view, rounding)) {
                continue;
            }
            best = {view, &relay, r.from, r.distance};
        }
    }

    void go(const SurfacePoint& to, Index face) {
        path_.points.push_back(to);
        path_.faces.emplace_back(face);
    }

    // Appends the site if the relay is its own.
    bool ends_at_site(const Chosen& chosen) {
        const auto end =
            field_.ends.of_relay(*chosen.relay, chosen.view, no_piece * chosen.distance);
        if (!end) return false;
        go(end->place, chosen.view.face.value());
        path_.site = chosen.relay->site;
        path_.start = end->start;
        return true;
    }
    // Whether the path ends where it leaves its face: at a side of the site, if the distance there
    // is that of the side.
    // \param way  from the point to there.
    bool ends_at_side(const Chosen& chosen, Index half_edge, double way) {
        const std::optional<double> start = field_.ends.at_side(half_edge, chosen.relay->site);
        if (!start) return false;
        const double left = chosen.distance - way - *start;
        const double error = std::max(nothing_left, field_.propagation.certified_error);
        const double rounding = image_in_face * surface_.length_of(half_edge);
        if (!(left <= error * chosen.distance + rounding)) return false;
        path_.site = chosen.relay->site;
        path_.start = *start;
        return true;
    }

    // To a corner at which the path bends.
    Chosen go_to_corner(const Chosen& chosen) {
        const Index h = chosen.relay->half_edge;
        const SurfacePoint corner = point_on(h, 0);
        go(corner, Surface::face(h));
        return choose(corner, chosen.relay->weight);
    }

    // Out of the face, and on while the image lies beyond and no corner on the line.
    Chosen go_across(const Chosen& chosen) {
        const Index h = chosen.relay->half_edge;
        ImageLine line{h, position_in_frame(surface_, chosen.view, h), chosen.from};
        // Parallel paths have no image: a point farther back serves.
        if (is_parallel(*chosen.relay)) line.image += line.image - line.from;
        const bool is_exact = field_.propagation.certified_error == 0;
        double way = 0;
        for (Index left = surface_.num_faces(); left > 0; --left) {
            ticker_.tick();
            const double at = leave(line);
            way += (Vec2(at * surface_.length_of(line.half_edge), 0) - line.from).norm();
            if (ends_at_side(chosen, line.half_edge, way)) return {};
            if (const auto corner = corner_met(line, at)) {
                return choose(point_on(*corner, 0), chosen.distance);
            }
            const Index inside = surface_.twin[line.half_edge];
            if (inside == no_index) return {};
            const Vec2 end(surface_.length_of(inside), 0);
            line = {inside, end - Vec2(at * end.x(), 0), end - line.image};
            const std::optional<Index> beyond = side_towards(line);
            if (!is_exact || !beyond) {
                Chosen next;
                choose_in_face(point_on(inside, 1 - at), inside, chosen.distance, next);
                return next;
            }
            line = seen_along(line, *beyond);
        }
        return {};
    }
    // The corner at which the line leaves its face, if it does not begin there.
    [[nodiscard]] std::optional<Index> corner_met(const ImageLine& line, double at) const {
        if (at > 0 && at < 1) return std::nullopt;
        const double length = surface_.length_of(line.half_edge);
        const double way = (Vec2(at * length, 0) - line.from).norm();
        if (!(way > image_in_face * length)) return std::nullopt;
        return at > 0 ? Surface::next(line.half_edge) : line.half_edge;
    }
    // Appends the point where the line leaves its face. Returns the share of the half-edge there: 0
    // or 1 at a corner.
    double leave(const ImageLine& line) {
        const double length = surface_.length_of(line.half_edge);
        const double fall = line.from.y() - line.image.y();
        const double share = fall > 0 ? line.from.y() / fall : 0;
        const double along = line.from.x() + share * (line.image.x() - line.from.x());
        double at = std::clamp(along / length, 0.0, 1.0);
        if (at < image_in_face) at = 0;
        if (at > 1 - image_in_face) at = 1;
        go(point_on(line.half_edge, at), Surface::face(line.half_edge));
        return at;
    }
    // The other half-edge of the face through which the line goes on; none: the image lies in it.
    [[nodiscard]] std::optional<Index> side_towards(const ImageLine& line) const {
        const Index inside = line.half_edge;
        const Vec2 apex = surface_.apex[inside], end(surface_.length_of(inside), 0);
        const Vec2 way = line.image - line.from;
        const bool is_left = cross(way, apex - line.from) > 0;  // The apex.
        const Vec2 tail = is_left ? end : apex, head = is_left ? apex : Vec2(0, 0);
        const Vec2 along = head - tail;
        const double beyond = cross(along, tail - line.image);  // > 0: across that side.
        if (!(beyond > image_in_face * along.squaredNorm())) return std::nullopt;
        return is_left ? Surface::next(inside) : Surface::previous(inside);
    }
    // The same line in the frame of another half-edge of the face.
    [[nodiscard]] ImageLine seen_along(const ImageLine& line, Index half_edge) const {
        const Index inside = line.half_edge;
        const Vec2 apex = surface_.apex[inside], end(surface_.length_of(inside), 0);
        const bool is_next = half_edge == Surface::next(inside);
        const Vec2 tail = is_next ? end : apex, head = is_next ? apex : Vec2(0, 0);
        const Vec2 along = (head - tail) / surface_.length_of(half_edge);
        const auto moved = [&](const Vec2& p) {
            const Vec2 step = p - tail;
            return Vec2(step.dot(along), cross(along, step));
        };
        return {half_edge, moved(line.from), moved(line.image)};
    }

    const Surface& surface_;
    const TracedField& field_;
    Ticker& ticker_;
    TracedPath path_;
};

}  // namespace

std::optional<TracedPath> trace_to_site(const TracedField& field, const SurfacePoint& point,
                                        Ticker& ticker) {
    return RelayTracer(field, point, ticker).run();
}

}  // namespace agvd
