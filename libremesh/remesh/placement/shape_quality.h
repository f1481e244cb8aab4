//! \file
//! The quality of a triangle as one number, and the steps of a vertex that improve it.
#pragma once

#include <algorithm>
#include <array>
#include <numbers>
#include <span>
#include <vector>

#include "agvd/core/portable_math.h"
#include "agvd/mesh/mesh.h"
#include "remesh/sites/sizing.h"

namespace remesh::detail {

//! Triangles of lower quality are improved: of those with two equal angles, the ones with an angle
//! above 92 degrees.
inline constexpr double low_quality = 0.7;
//! Factor of the sine of the smallest angle: 36.6 degrees count as `low_quality`.
inline constexpr double sine_weight = low_quality / 0.597;

//! 6 / sqrt(3) * S / (p h) ([frey1999]): S area, p half the perimeter, h the longest edge; lower if
//! an angle is small, or near 180 degrees. 0 to 1.
[[nodiscard]] inline double shape_quality(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = b - a, v = c - a, w = c - b;
    const double ab = u.norm(), bc = w.norm(), ca = v.norm();
    const double doubled_area = u.cross(v).norm();
    if (!(doubled_area > 0)) return 0;
    const double longest = std::max({ab, bc, ca});
    // The smallest angle is the one between the longest sides.
    const double sine = doubled_area * std::min({ab, bc, ca}) / (ab * bc * ca);
    // The largest angle lies opposite the longest side.
    const double squares = ab * ab + bc * bc + ca * ca - 2 * longest * longest;
    const double cosine = squares * longest / (2 * ab * bc * ca);
    return std::min({2 * std::numbers::sqrt3 * doubled_area / ((ab + bc + ca) * longest),
                     sine_weight * sine, 2 * (1 + cosine)});
}

//! The shape_quality() of a triangle; with bounds, where these come first: below `low_quality` if a
//! bound is exceeded, by how much, and above it by the quality.
class ShapeMeasure {
public:
    //! \param bounds  their angles are kept with some room for the rounding of files.
    explicit ShapeMeasure(const ShapeBounds& bounds = {})
        : has_bounds_(bounds.has_any()),
          least_angle_(bounds.min_angle > 0 ? (bounds.min_angle + room) * degree : 0),
          least_rest_(bounds.max_angle < 180 ? (180 - bounds.max_angle + room) * degree : 0),
          longest_((1 - relative_room) * bounds.longest_edge) {}

    [[nodiscard]] bool has_bounds() const { return has_bounds_; }
    [[nodiscard]] double operator()(const Vec3& a, const Vec3& b, const Vec3& c) const {
        const double quality = shape_quality(a, b, c);
        if (!has_bounds_ || !(quality > 0)) return quality;
        const double kept = kept_share({a, b, c});
        return kept < 1 ? low_quality * kept : within_bounds(quality);
    }
    //! What a shape_quality() within the bounds counts as.
    [[nodiscard]] static constexpr double within_bounds(double quality) {
        return low_quality + (1 - low_quality) * quality;
    }
    //! The inverse of within_bounds().
    [[nodiscard]] static constexpr double shape_within_bounds(double quality) {
        return (quality - low_quality) / (1 - low_quality);
    }

private:
    static constexpr double room = 1e-4, relative_room = 1e-5;  // Degrees, and of the length.

    // 1 or more if all bounds are kept.
    [[nodiscard]] double kept_share(const std::array<Vec3, 3>& corners) const {
        double smallest = std::numbers::pi, largest = 0, longest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 u = corners[(k + 1) % 3] - corners[k], v = corners[(k + 2) % 3] - corners[k];
            const double angle = portable::atan2(u.cross(v).norm(), u.dot(v));
            smallest = std::min(smallest, angle);
            largest = std::max(largest, angle);
            longest = std::max(longest, u.norm());
        }
        double share = longest_ / longest;
        if (least_angle_ > 0) share = std::min(share, smallest / least_angle_);
        if (least_rest_ > 0) share = std::min(share, (std::numbers::pi - largest) / least_rest_);
        return share;
    }

    bool has_bounds_;
    double least_angle_, least_rest_, longest_;  // Radians, and mesh units.
};

//! Appends eight unit vectors orthogonal to `normal`, which is not zero.
inline void add_directions(const Vec3& normal, std::vector<Vec3>& directions) {
    const Vec3 x = normal.unitOrthogonal(), y = normal.normalized().cross(x);
    const Vec3 between = (x + y) / std::numbers::sqrt2, beyond = (y - x) / std::numbers::sqrt2;
    for (const double sign : {1, -1}) {
        for (const Vec3& direction : {x, between, y, beyond}) {
            directions.emplace_back(sign * direction);
        }
    }
}

//! Tries steps of three lengths in all directions, and repeats each length while it helps.
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

[[nodiscard]] inline double longest_edge_of(const std::array<Vec3, 3>& t) {
    return std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
}

//! Whether two triangles at an edge lie nearly on each other, with less than a degree between them.
//! Others take them for triangles that intersect. One without area is no fold.
//! \param a, b  their normals, of any length.
[[nodiscard]] inline bool is_fold(const Vec3& a, const Vec3& b) {
    constexpr double cosine = 0.99984769515639;  // Of a degree.
    return a.dot(b) < -cosine * a.norm() * b.norm();
}

}  // namespace remesh::detail
