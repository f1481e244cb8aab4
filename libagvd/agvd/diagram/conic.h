//! \file
//! The points that are as far from one weighted point of the plane as from another.
#pragma once

#include <array>
#include <optional>

#include "agvd/core/types.h"

namespace agvd {

//! The points p with |p - focus[0]| + weight[0] = |p - focus[1]| + weight[1]: one branch of a
//! hyperbola, or a line.
struct Conic {
    std::array<Vec2, 2> focus{Vec2(0, 0), Vec2(0, 0)};
    std::array<double, 2> weight{};

    [[nodiscard]] double distance(std::size_t k, const Vec2& p) const {
        return (p - focus[k]).norm() + weight[k];
    }
    //! By how much the first distance of a point exceeds the second, and how fast that grows.
    [[nodiscard]] double gap(const Vec2& p) const { return distance(0, p) - distance(1, p); }
    [[nodiscard]] Vec2 gradient(const Vec2& p) const;
    [[nodiscard]] bool is_line() const;

    //! Where the ray from a focus meets the conic: once at most.
    [[nodiscard]] std::optional<Vec2> on_ray(std::size_t k, const Vec2& direction) const;
    //! The point of the conic near p.
    [[nodiscard]] Vec2 moved_onto(const Vec2& p) const;
    //! The point between two points of the conic on a ray through the chord's point at this share.
    [[nodiscard]] Vec2 between(const Vec2& from, const Vec2& to, double share) const;
    //! More than the distance of the part between two points of the conic from its chord; infinity
    //! if the part turns by a right angle or more.
    [[nodiscard]] double most_stray(const Vec2& from, const Vec2& to) const;
};

}  // namespace agvd
