//! \file
//! The steps by which a vertex is moved to improve the triangles around it.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Appends eight unit vectors orthogonal to `normal`, which is not zero.
inline void add_directions(const Vec3& normal, std::vector<Vec3>& directions) {
    constexpr int count = 8;
    const Vec3 x = normal.unitOrthogonal(), y = normal.normalized().cross(x);
    for (int d = 0; d < count; ++d) {
        const double angle = 2 * std::numbers::pi * d / count;
        directions.emplace_back(std::cos(angle) * x + std::sin(angle) * y);
    }
}

//! Tries steps of three lengths in all directions, and repeats each length while it helps.
//!
//! \param length    the mean length of the edges around the vertex.
//! \param try_step  try_step(step) moves the vertex and returns true if that is better.
//! \return true if a step was taken.
template <typename TryStep>
bool try_steps(std::span<const Vec3> directions, double length, const TryStep& try_step) {
    constexpr std::array shares{0.2, 0.07, 0.02};  // Of the length.
    constexpr int most_tries = 4;
    bool is_better = false;
    for (const double share : shares) {
        bool helps = true;
        for (int tries = 0; tries < most_tries && helps; ++tries) {
            helps = false;
            for (const Vec3& direction : directions) {
                helps = try_step(share * length * direction) || helps;
            }
            is_better = is_better || helps;
        }
    }
    return is_better;
}

}  // namespace remesh::detail
