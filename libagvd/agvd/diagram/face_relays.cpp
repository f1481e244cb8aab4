#include "agvd/diagram/face_relays.h"

#include <algorithm>

#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

// Of parallel paths the unit vector towards the line; of a region 0.
Vec2 direction_of(const Relay& relay) {
    if (relay.y > 0) return {0, 0};
    return {relay.x, -std::sqrt(std::max(1 - relay.x * relay.x, 0.0))};
}

CornerDistances corner_distances_parallel(const Relay& relay, double length, const Vec2& apex) {
    const PlanarRelay planar = to_planar_parallel(relay, {});
    return {reach_parallel(planar, {0, 0}).distance, reach_parallel(planar, {length, 0}).distance,
            reach_parallel(planar, apex).distance};
}

}  // namespace

PlanarRelay point_relay(const Vec2& point, double weight, Index site) {
    return {point, point, point, weight, weight, weight, site, true};
}

Reach reach_parallel(const PlanarRelay& relay, const Vec2& p) {
    const auto from_end = [&p](const Vec2& end, double weight) -> Reach {
        const double length = (p - end).norm();
        return {weight + length, end, length};
    };
    const Vec2& u = relay.image;
    if (cross(u, p - relay.begin) < 0) return from_end(relay.begin, relay.at_begin);
    if (cross(u, p - relay.end) > 0) return from_end(relay.end, relay.at_end);
    const double distance = std::max(relay.weight - p.dot(u), 0.0);
    // Far enough that the direction keeps its digits beside the line.
    const double back = std::max(distance, (relay.end - relay.begin).norm());
    return {distance, p + back * u, back};
}

PlanarRelay to_planar_parallel(const Relay& relay, const Motion& motion) {
    const Vec2 u = motion(direction_of(relay)) - motion.origin;
    return {u,
            motion({relay.begin, 0}),
            motion({relay.end, 0}),
            relay.weight + u.dot(motion.origin),
            relay.weight - relay.begin * relay.x,
            relay.weight - relay.end * relay.x,
            relay.site.value(),
            false,
            true};
}

std::array<Vec2, 3> face_corners(const Surface& surface, Index face) {
    return {Vec2(0, 0), Vec2(surface.length_of(3 * face), 0), surface.apex[3 * face]};
}

Motion to_face_frame(const Surface& surface, Index half_edge) {
    const std::array<Vec2, 3> corners = face_corners(surface, Surface::face(half_edge));
    const Vec2& tail = corners[half_edge % 3];
    const Vec2& head = corners[(half_edge + 1) % 3];
    return {(head - tail) / surface.length_of(half_edge), tail};
}

SurfacePoint to_surface(const Surface& surface, Index face, const Vec2& p) {
    const Vec2& apex = surface.apex[3 * face];
    const double at_apex = std::clamp(p.y() / apex.y(), 0.0, 1.0);
    const double at_head =
        std::clamp((p.x() - at_apex * apex.x()) / surface.length_of(3 * face), 0.0, 1.0 - at_apex);
    return {FaceId(face), {1.0 - at_apex - at_head, at_head, at_apex}};
}

CornerDistances corner_distances(const Relay& r, double length, const Vec2& apex) {
    const double cx = apex.x();
    const double cy = apex.y();
    if (is_parallel(r)) return corner_distances_parallel(r, length, apex);
    if (r.y >= 0) {
        return {r.weight + root(r.x, r.y), r.weight + root(length - r.x, r.y),
                r.weight + root(cx - r.x, cy - r.y)};
    }
    const double begin = root(r.begin - r.x, r.y);
    const double end = root(r.end - r.x, r.y);
    CornerDistances result{r.weight + begin + r.begin, r.weight + end + (length - r.end), 0};
    // The chord to the apex meets the edge at x + (cx - x) (-y) / (cy - y).
    const double height = cy - r.y;
    const double hit = (cx - r.x) * -r.y;
    if (hit < (r.begin - r.x) * height) {
        result.apex = r.weight + begin + root(cx - r.begin, cy);
    } else if (hit > (r.end - r.x) * height) {
        result.apex = r.weight + end + root(cx - r.end, cy);
    } else {
        result.apex = r.weight + root(cx - r.x, height);
    }
    return result;
}

std::span<const PlanarRelay> of_site(std::span<const PlanarRelay> relays, Index site) {
    const auto first = std::lower_bound(
        relays.begin(), relays.end(), site,
        [](const PlanarRelay& relay, Index wanted) { return relay.site < wanted; });
    auto last = first;
    while (last != relays.end() && last->site == site) ++last;
    return {first, last};
}

Reach least_reach(std::span<const PlanarRelay> relays, const Vec2& p) {
    Reach best{infinity, p, 0};
    for (const PlanarRelay& relay : relays) {
        const Reach r = reach(relay, p);
        if (r.distance < best.distance) best = r;
    }
    return best;
}

Nearest nearest(std::span<const PlanarRelay> relays, const Vec2& p) {
    Nearest best{no_index, infinity};
    for (const PlanarRelay& relay : relays) {
        const double distance = reach(relay, p).distance;
        if (is_nearer(distance, relay.site, best.distance, best.site))
            best = {relay.site, distance};
    }
    return best;
}

PointLabel label_in_face(const Surface& surface, const Propagation& propagation,
                         std::optional<Index> mixed, SiteId site_of_corners,
                         const SurfacePoint& point) {
    if (!mixed) return {site_of_corners, {}};
    std::vector<PlanarRelay> planar;
    for (const Relay& relay : relays_of(propagation, *mixed)) {
        planar.push_back(to_planar(relay, to_face_frame(surface, relay.half_edge)));
    }
    const Nearest label =
        nearest(planar, position_in_frame(surface, point, 3 * point.face.value()));
    return {SiteId(label.site), label.distance};
}

PointLabel point_label(const Surface& surface, const Propagation& propagation,
                       const SurfacePoint& point) {
    const Index face = point.face.value();
    return label_in_face(surface, propagation, mixed_index_of(propagation, face),
                         propagation.vertex_site[surface.mesh.triangles[face][0]], point);
}

PointLabel label_at(const Surface& surface, const Propagation& propagation,
                    const SurfacePoint& point) {
    const std::optional<Index> vertex = vertex_of(surface, point);
    if (!vertex) return point_label(surface, propagation, point);
    return {propagation.vertex_site[*vertex], propagation.vertex_distance[*vertex]};
}

LineRelay on_line(const PlanarRelay& relay, const Vec2& start, const Vec2& along, double length) {
    LineRelay line{};
    line.first = -infinity;
    line.last = infinity;
    line.site = relay.site;
    const auto set = [&](std::size_t source, const Vec2& p, double weight) {
        const Vec2 d = p - start;
        line.x[source] = d.dot(along);
        line.y[source] = cross(along, d);
        line.weight[source] = weight;
    };
    if (relay.is_parallel) {
        line.x[1] = relay.image.dot(along);
        line.y[1] = cross(along, relay.image) < 0 ? -infinity : infinity;
        line.weight[1] = relay.weight - relay.image.dot(start);
    } else {
        set(1, relay.image, relay.weight);
    }
    if (relay.sees_all) return line;
    // Out of sight beyond `begin` where behind(x) = at_start + rise * x > 0, and beyond `end` where
    // the same with the sign turned. Only one of them can apply on one side of the segment.
    const auto hide = [&](const Vec2& end, double weight, double sign) {
        const Vec2 ray = relay.is_parallel ? Vec2(-relay.image) : Vec2(end - relay.image);
        const double at_start = sign * cross(ray, start - (relay.is_parallel ? end : relay.image));
        const double rise = sign * cross(ray, along);
        if (rise < 0 ? at_start > 0 : rise == 0 && at_start > 0) {
            line.first = rise < 0 ? -at_start / rise : infinity;
            set(0, end, weight);
        } else if (rise > 0 && at_start + rise * length > 0) {
            line.last = -at_start / rise;
            set(2, end, weight);
        }
    };
    hide(relay.begin, relay.at_begin, 1);
    hide(relay.end, relay.at_end, -1);
    return line;
}

double distance_on_line(std::span<const LineRelay> relays, Index site, double x) {
    double least = infinity;
    for (const LineRelay& relay : relays) {
        if (relay.site == site) least = std::min(least, sample(relay, x).value);
    }
    return least;
}

void append_pieces(std::span<const LineRelay> relays, Index site, double begin, double end,
                   std::vector<StraightPiece>& out) {
    const auto first = static_cast<std::ptrdiff_t>(out.size());
    const auto append = [&](const LineRelay& relay, std::size_t source, double lo, double hi) {
        if (!(hi > lo)) return;
        const Vec2 from(relay.x[source], relay.y[source]);
        // Paths that bend at one point are one.
        const auto same = std::find_if(out.begin() + first, out.end(), [&](const auto& piece) {
            return piece.from == from && piece.weight == relay.weight[source];
        });
        if (same == out.end()) {
            out.push_back({from, relay.weight[source], lo, hi, site});
        } else {
            same->begin = std::min(same->begin, lo);
            same->end = std::max(same->end, hi);
        }
    };
    for (const LineRelay& relay : relays) {
        if (relay.site != site) continue;
        const double straight = std::clamp(relay.first, begin, end);
        const double bent = std::clamp(relay.last, straight, end);
        append(relay, 0, begin, straight);
        append(relay, 1, straight, bent);
        append(relay, 2, bent, end);
    }
}

}  // namespace agvd
