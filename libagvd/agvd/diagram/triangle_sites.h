//! \file
//! A triangle and the distances from the sites on its boundary.
#pragma once

#include "agvd/diagram/face_relays.h"

namespace agvd {

// Shares of the triangle's size, its longest side.

//! Equalities are met up to this: below it lies rounding.
inline constexpr double convergence = 1e-11;
//! A point this far outside still counts as inside.
inline constexpr double inside_tolerance = 1e-9;

inline constexpr int max_newton_steps = 25;

using Relays = std::span<const PlanarRelay>;

//! Every cell inside reaches the boundary: other sites than those on it do not matter.
struct TriangleSites {
    struct Group {
        Index site;
        Relays relays;
    };
    std::array<Vec2, 3> corners;  //!< Counter-clockwise.
    double size = 0;              //!< Longest side.
    std::vector<Group> groups;
};

[[nodiscard]] double longest_side(const std::array<Vec2, 3>& corners);

//! Empty for a site that is not on the boundary.
[[nodiscard]] Relays relays_of_site(const TriangleSites& triangle, Index site);

//! How far a point lies outside; 0: inside.
[[nodiscard]] double outside(const TriangleSites& triangle, const Vec2& p);

//! The point, moved towards the centroid until it is inside.
[[nodiscard]] Vec2 moved_inside(const TriangleSites& triangle, const Vec2& p);

//! By how much another site than these is nearer to p.
//! \param distance  of p from these.
[[nodiscard]] double undercut(const TriangleSites& triangle, const Vec2& p, double distance,
                              std::span<const Index> sites);

//! Null without relays.
[[nodiscard]] const PlanarRelay* nearest_relay(Relays relays, const Vec2& p);

//! The gradient of a distance at p; 0 at the end of the last piece itself.
[[nodiscard]] inline Vec2 gradient(const Vec2& p, const Reach& reach) {
    return reach.last_piece > 0 ? Vec2((p - reach.from) / reach.last_piece) : Vec2(0, 0);
}

}  // namespace agvd
