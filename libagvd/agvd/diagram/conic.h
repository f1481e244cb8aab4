//! \file
//! The points that are as far from one weighted point as from another. Private to diagrams.
#pragma once

#include <array>

#include "agvd/core/types.h"

namespace agvd {

//! A branch of a hyperbola, or a line. All in one plane.
struct Conic {
    std::array<Vec2, 2> focus{Vec2(0, 0), Vec2(0, 0)};
    std::array<double, 2> weight{};

    //! By how much the first distance exceeds the second.
    [[nodiscard]] double gap(const Vec2& p) const;
    //! Of gap(): at most 2 long.
    [[nodiscard]] Vec2 gradient(const Vec2& p) const;
    //! Whether the branch is straight.
    [[nodiscard]] bool is_line() const;
    //! Where the ray from a focus meets the branch; not finite where it is parallel to it. Behind
    //! the focus if only the other branch does.
    [[nodiscard]] Vec2 on_ray(std::size_t from, const Vec2& direction) const;
    //! The point of the branch that Newton steps along the gradient lead to.
    [[nodiscard]] Vec2 moved_onto(const Vec2& start) const;
    //! The point of the branch across from the chord's point at a share of its way: on the chord's
    //! normal, or else as seen from a focus.
    [[nodiscard]] Vec2 opposite(const Vec2& from, const Vec2& to, double share) const;
};

}  // namespace agvd
