//! \file
//! The relays of one face in one plane or seen from one line, and distances through them.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "agvd/propagation/propagate.h"

namespace agvd {

//! A relay in a planar frame shared with other relays.
struct PlanarRelay {
    Vec2 image;       //!< Of parallel paths the unit vector towards the line; of a region 0.
    Vec2 begin, end;  //!< Ends of the visible interval, seen from the image left and right.
    //! Distance from the site to the image; of parallel paths from the line to the origin.
    double weight;
    double at_begin;  //!< Distance from the site to `begin` through the image.
    double at_end;    //!< Distance from the site to `end` through the image.
    Index site;
    bool sees_all;             //!< The image lies in the face: no interval.
    bool is_parallel = false;  //!< See agvd::is_parallel().
};

//! Distance of a point through a relay, and where the last straight piece of the path begins.
struct Reach {
    double distance;
    Vec2 from;          //!< Of parallel paths any point behind on the path.
    double last_piece;  //!< Length of that piece; of parallel paths to `from`.
};

//! The length of a vector.
[[nodiscard]] inline double root(double x, double y) { return std::sqrt(x * x + y * y); }

//! reach() for parallel paths.
[[nodiscard]] Reach reach_parallel(const PlanarRelay& relay, const Vec2& p);

//! Straight where the interval lets the chord through, else bent at its nearer end.
[[nodiscard]] inline Reach reach(const PlanarRelay& relay, const Vec2& p) {
    const auto from = [&p](const Vec2& source, double weight) -> Reach {
        const double length = (p - source).norm();
        return {weight + length, source, length};
    };
    if (!relay.sees_all) {
        if (relay.is_parallel) return reach_parallel(relay, p);
        const Vec2 chord = p - relay.image;
        if (cross(relay.begin - relay.image, chord) > 0) return from(relay.begin, relay.at_begin);
        if (cross(relay.end - relay.image, chord) < 0) return from(relay.end, relay.at_end);
    }
    return from(relay.image, relay.weight);
}

//! The relay of a point that lies in the face itself.
[[nodiscard]] PlanarRelay point_relay(const Vec2& point, double weight, Index site);

//! In the frame of half-edge 3 f: the own frame of a face that stands alone.
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

//! At a position in the face's own frame; outside, at the nearest edge.
[[nodiscard]] SurfacePoint to_surface(const Surface& surface, Index face, const Vec2& p);

//! From the frame of a half-edge into the frame of its face's first half-edge.
[[nodiscard]] Motion to_face_frame(const Surface& surface, Index half_edge);

//! to_planar() for parallel paths.
[[nodiscard]] PlanarRelay to_planar_parallel(const Relay& relay, const Motion& motion);

//! A relay, moved from its half-edge's frame.
[[nodiscard]] inline PlanarRelay to_planar(const Relay& relay, const Motion& motion) {
    if (is_parallel(relay)) return to_planar_parallel(relay, motion);
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

struct PointLabel {
    SiteId site;                     //!< Nearest site; invalid where none reaches.
    std::optional<double> distance;  //!< Through the relays; unknown in faces of one label.
};

//! What a propagation says at a point of its face: by its relays, or by its one label. Of the
//! propagation it reads relays.
//! \param mixed            position of the face in mixed_faces; unset: it is unlisted.
//! \param site_of_corners  the label of an unlisted face.
[[nodiscard]] PointLabel label_in_face(const Surface& surface, const Propagation& propagation,
                                       std::optional<Index> mixed, SiteId site_of_corners,
                                       const SurfacePoint& point);

//! What a propagation says at a point: by the relays of its face, or by its one label.
[[nodiscard]] PointLabel point_label(const Surface& surface, const Propagation& propagation,
                                     const SurfacePoint& point);

//! The same; at a vertex what the propagation says of it.
[[nodiscard]] PointLabel label_at(const Surface& surface, const Propagation& propagation,
                                  const SurfacePoint& point);

// --- Seen from a segment -----------------------------------------------------------------------
//
// The segment lies on the x axis and begins at the origin. The distance from a site through a relay
// is f(x) = w + sqrt((x - a)^2 + b^2), with the source (a, b) of the last straight piece of the
// path at distance w from the site: the image, or the end of the interval where paths bend.

// Share of a segment: label changes nearer to each other are not told apart.
inline constexpr double shortest_interval = 1e-11;
// At a change the two distances are equal up to this: below it lies rounding.
inline constexpr double equal_distances = 1e-11;

//! Up to x = `first` paths bend at one end of the interval (source 0), from `last` on at the other
//! end (source 2), and between they come straight from the image (source 1). Of parallel paths the
//! image has y = infinity with the sign of its side; x is the component of the unit vector towards
//! the line along the segment, and the weight the distance of the origin.
struct LineRelay {
    std::array<double, 3> x, y, weight;  //!< Of the three sources.
    double first, last;
    Index site;
};

//! Distance, its derivative (at a source: to the right), and the source of the last piece.
struct LineSample {
    double value, slope;
    int source;
};

// By force: it is called in too many places for the compiler.
[[nodiscard, gnu::always_inline]] inline LineSample sample(const LineRelay& relay, double x) {
    const int i = x < relay.first ? 0 : x > relay.last ? 2 : 1;
    const auto k = static_cast<std::size_t>(i);
    const double dx = x - relay.x[k];
    const double norm = std::sqrt(dx * dx + relay.y[k] * relay.y[k]);
    if (norm == infinity) return {relay.weight[k] - x * relay.x[k], -relay.x[k], i};
    return {relay.weight[k] + norm, norm > 0 ? dx / norm : 1.0, i};
}

//! A relay on a segment from `start` in a direction of length 1.
[[nodiscard]] LineRelay on_line(const PlanarRelay& relay, const Vec2& start, const Vec2& along,
                                double length);

//! A point at (x, 0).
[[nodiscard]] inline LineRelay point_on_line(double x, double weight, Index site) {
    return {{x, x, x}, {0, 0, 0}, {weight, weight, weight}, -infinity, infinity, site};
}

//! Least distance over the relays of one site; infinity if it has none.
[[nodiscard]] double distance_on_line(std::span<const LineRelay> relays, Index site, double x);

//! From `begin` to `end` (lengths along the segment) a site is reached straight from `from`, itself
//! at distance `weight` from it.
struct StraightPiece {
    Vec2 from;
    double weight;
    double begin, end;
    Index site;
};

//! Appends what the relays of one site say about a stretch of the segment.
void append_pieces(std::span<const LineRelay> relays, Index site, double begin, double end,
                   std::vector<StraightPiece>& out);

}  // namespace agvd
