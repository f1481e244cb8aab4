//! \file
//! Helpers of operations on faces: they move sides to other half-edges and update what refers to
//! sides. Private to intrinsic.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "agvd/intrinsic/face_charts.h"
#include "agvd/mesh/surface.h"

namespace agvd::detail {

//! Twice the area that a degenerate face gets, as a share of the square of its longest edge. That
//! changes its lengths by less than rounding.
inline constexpr double least_doubled_area = 0x1p-50;

//! The least length of an edge that an operation makes, as a share of the longest edge beside it:
//! rounding might make it 0.
inline constexpr double least_length = 0x1p-50;

[[nodiscard]] inline double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

[[nodiscard]] inline double longest_side(const Surface& surface, Index face) {
    return std::max({surface.length_of(3 * face), surface.length_of(3 * face + 1),
                     surface.length_of(3 * face + 2)});
}

//! The height of a face over an edge. It is at most the longest side: over an edge as short as the
//! rounding of the longest side, rounding may have made the area too large.
[[nodiscard]] inline double height_over(double length, double doubled_area, double longest) {
    return std::min(doubled_area / length, longest);
}

//! Sets the three apexes of a face from its chart. The lengths of sides are those of the chart,
//! which may differ from the edges' lengths by rounding.
inline void set_apexes(Surface& surface, Index face, const FaceChart& chart) {
    const double longest = longest_side(surface, face);
    const double doubled_area =
        std::max(-cross(chart.side[0], chart.side[2]), least_doubled_area * longest * longest);
    for (std::size_t k = 0; k < 3; ++k) {
        const double length = std::max(chart.side[k].norm(), least_length * longest);
        surface.apex[3 * face + k] = {-chart.side[k].dot(chart.side[(k + 2) % 3]) / length,
                                      height_over(length, doubled_area, longest)};
    }
}

//! An edge of a face, as other faces see it.
struct Side {
    Index half_edge;
    Index twin;
    Index edge;
};

[[nodiscard]] inline Side side_of(const Surface& surface, Index half_edge) {
    return {half_edge, surface.twin[half_edge], surface.edge[half_edge]};
}

inline void join(Surface& surface, Index half_edge, Index twin, Index edge) {
    surface.twin[half_edge] = twin;
    surface.edge[half_edge] = edge;
    if (twin != no_index) surface.twin[twin] = half_edge;
    surface.edge_half[edge] = std::min(half_edge, twin);
}

//! Gives sides their new half-edges. If a side is the twin of another one, both have moved.
template <std::size_t N>
void move_sides(Surface& surface, const std::array<Side, N>& sides,
                const std::array<Index, N>& places) {
    for (std::size_t i = 0; i < N; ++i) {
        Index twin = sides[i].twin;
        for (std::size_t k = 0; k < N; ++k) {
            if (twin != no_index && sides[k].half_edge == twin) {
                twin = places[k];
                break;
            }
        }
        join(surface, places[i], twin, sides[i].edge);
    }
}

//! Gives an outgoing half-edge to vertices that have none: on the boundary the one without twin.
inline void renew_outgoing(Surface& surface, std::span<const Index> faces) {
    for (const Index face : faces) {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            Index& outgoing = surface.outgoing[surface.tail(h)];
            if (surface.twin[h] == no_index || outgoing == no_index) outgoing = h;
        }
    }
}

//! Removes the outgoing half-edges that lie in faces that are about to change.
inline void forget_outgoing(Surface& surface, std::span<const Index> faces) {
    for (const Index face : faces) {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            if (surface.outgoing[surface.tail(h)] == h)
                surface.outgoing[surface.tail(h)] = no_index;
        }
    }
}

}  // namespace agvd::detail
