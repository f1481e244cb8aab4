//! \file
//! The relays of one face in one plane, and distances through them.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "agvd/propagation/propagate.h"

namespace agvd {

//! A relay in a planar frame shared with other relays.
struct PlanarRelay {
    Vec2 image;
    Vec2 begin, end;  //!< Ends of the visible interval, seen from the image left and right.
    double weight;    //!< Distance from the site to the image.
    double at_begin;  //!< Distance from the site to `begin` through the image.
    double at_end;    //!< Distance from the site to `end` through the image.
    Index site;
    bool sees_all;  //!< The image lies in the face: no interval.
};

//! Distance of a point through a relay, and where the last straight piece of the path begins.
struct Reach {
    double distance;
    Vec2 from;
    double last_piece;  //!< Length of that piece.
};

[[nodiscard]] inline double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

//! Straight where the interval lets the chord through, else bent at its nearer end.
[[nodiscard]] inline Reach reach(const PlanarRelay& relay, const Vec2& p) {
    const auto from = [&p](const Vec2& source, double weight) -> Reach {
        const double length = (p - source).norm();
        return {weight + length, source, length};
    };
    if (!relay.sees_all) {
        const Vec2 chord = p - relay.image;
        if (cross(relay.begin - relay.image, chord) > 0) return from(relay.begin, relay.at_begin);
        if (cross(relay.end - relay.image, chord) < 0) return from(relay.end, relay.at_end);
    }
    return from(relay.image, relay.weight);
}

//! The relay of a point that lies in the face itself.
[[nodiscard]] PlanarRelay point_relay(const Vec2& point, double weight, Index site);

//! The corners of a face in the frame of its first half-edge (half-edge 3 f), which is the face's
//! own frame wherever a face stands alone.
[[nodiscard]] std::array<Vec2, 3> face_corners(const Surface& surface, Index face);

//! A rigid motion of the plane.
struct Motion {
    Vec2 axis{1, 0};    //!< Image of the x axis; unit length.
    Vec2 origin{0, 0};  //!< Image of the origin.

    [[nodiscard]] Vec2 operator()(const Vec2& p) const {
        return {origin.x() + axis.x() * p.x() - axis.y() * p.y(),
                origin.y() + axis.y() * p.x() + axis.x() * p.y()};
    }
};

//! First `first`, then `second`.
[[nodiscard]] inline Motion compose(const Motion& second, const Motion& first) {
    return {second(first.axis) - second.origin, second(first.origin)};
}

//! The surface point at a position in the face's own frame; positions outside are moved to the
//! nearest edge.
[[nodiscard]] SurfacePoint to_surface(const Surface& surface, Index face, const Vec2& p);

//! From the frame of a half-edge into the frame of its face's first half-edge, and back.
[[nodiscard]] Motion to_face_frame(const Surface& surface, Index half_edge);
[[nodiscard]] Motion from_face_frame(const Surface& surface, Index half_edge);

//! A relay, moved from its half-edge's frame.
[[nodiscard]] inline PlanarRelay to_planar(const Relay& relay, const Motion& motion) {
    const auto root = [](double x, double y) { return std::sqrt(x * x + y * y); };
    return {motion({relay.x, relay.y}),
            motion({relay.begin, 0}),
            motion({relay.end, 0}),
            relay.weight,
            relay.weight + root(relay.begin - relay.x, relay.y),
            relay.weight + root(relay.end - relay.x, relay.y),
            relay.site.value(),
            relay.y >= 0};
}

//! Distances of the corners of a face through a relay: of the tail and head of its half-edge, and
//! of the corner opposite. Straight, or bent at an end of the interval.
struct CornerDistances {
    double tail, head, apex;
};

//! \param length, apex  of the relay's half-edge.
[[nodiscard]] CornerDistances corner_distances(const Relay& relay, double length, const Vec2& apex);

//! Appends relays, moved from their half-edges' frames by to_face_frame and then by `motion`.
void append_planar(const Surface& surface, std::span<const Relay> relays, const Motion& motion,
                   std::vector<PlanarRelay>& out);

//! Those of one site among relays by ascending site.
[[nodiscard]] std::span<const PlanarRelay> of_site(std::span<const PlanarRelay> relays, Index site);

//! Least distance over all relays; infinity if there is none.
[[nodiscard]] Reach least_reach(std::span<const PlanarRelay> relays, const Vec2& p);

struct Nearest {
    Index site;  //!< no_index without relays; of equally near sites the lowest.
    double distance;
};

//! The nearest site of a point of the face.
[[nodiscard]] Nearest nearest(std::span<const PlanarRelay> relays, const Vec2& p);

}  // namespace agvd
