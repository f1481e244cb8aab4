#include "agvd/diagram/face_relays.h"

#include <algorithm>
#include <limits>

namespace agvd {

PlanarRelay point_relay(const Vec2& point, double weight, Index site) {
    return {point, point, point, weight, weight, weight, site, true};
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

Motion from_face_frame(const Surface& surface, Index half_edge) {
    const Motion to = to_face_frame(surface, half_edge);
    const Motion back{{to.axis.x(), -to.axis.y()}, {0, 0}};
    return {back.axis, -back(to.origin)};
}

SurfacePoint to_surface(const Surface& surface, Index face, const Vec2& p) {
    const Vec2& apex = surface.apex[3 * face];
    const double at_apex = std::clamp(p.y() / apex.y(), 0.0, 1.0);
    const double at_head =
        std::clamp((p.x() - at_apex * apex.x()) / surface.length_of(3 * face), 0.0, 1.0 - at_apex);
    return {FaceId(face), {1.0 - at_apex - at_head, at_head, at_apex}};
}

CornerDistances corner_distances(const Relay& r, double length, const Vec2& apex) {
    const auto root = [](double x, double y) { return std::sqrt(x * x + y * y); };
    const double cx = apex.x();
    const double cy = apex.y();
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

void append_planar(const Surface& surface, std::span<const Relay> relays, const Motion& motion,
                   std::vector<PlanarRelay>& out) {
    Index half_edge = no_index;
    Motion to;
    for (const Relay& relay : relays) {
        if (relay.half_edge != half_edge) {
            half_edge = relay.half_edge;
            to = compose(motion, to_face_frame(surface, half_edge));
        }
        out.push_back(to_planar(relay, to));
    }
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
    Reach best{std::numeric_limits<double>::infinity(), p, 0};
    for (const PlanarRelay& relay : relays) {
        const Reach r = reach(relay, p);
        if (r.distance < best.distance) best = r;
    }
    return best;
}

Nearest nearest(std::span<const PlanarRelay> relays, const Vec2& p) {
    Nearest best{no_index, std::numeric_limits<double>::infinity()};
    for (const PlanarRelay& relay : relays) {
        const double distance = reach(relay, p).distance;
        if (is_nearer(distance, relay.site, best.distance, best.site))
            best = {relay.site, distance};
    }
    return best;
}

}  // namespace agvd
