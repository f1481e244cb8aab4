//! \file
//! How a vertex was reached, in the vertex engine.
#pragma once

#include <array>
#include <limits>

#include "agvd/core/types.h"

namespace agvd {

//! Distance and site of a vertex. They are stored apart from the view, since they are read and
//! written for every neighbour of every vertex.
struct VertexReach {
    double distance = std::numeric_limits<double>::infinity();
    Index site = no_index;
    Index queued_in = no_index;  //!< Bucket; no_index: served, or never reached.
};

enum class ViewKind : std::uint32_t {
    Site,      //!< A site lies on the vertex, or nothing has reached it.
    Face,      //!< Straight from a site in the face of half_edge, at whose apex the vertex is.
    Window,    //!< Straight from an image behind half_edge, at whose apex the vertex is.
    FromTail,  //!< Along half_edge to its head.
    FromHead,  //!< Along half_edge (on the boundary, so without twin) to its tail.
};

//! The image of a site (or of a vertex at which the path bends) that a vertex sees: 48 bytes.
struct VertexView {
    Vec2 image{0, 0};   //!< In the frame of half_edge; Face and Window only.
    double weight = 0;  //!< Distance from the site to the image; Face and Window only.
    //! Outermost directions from the image between which paths are straight; Window only. Floats
    //! suffice: a chord that misses a vertex by their rounding is too short by the square of it.
    std::array<float, 2> left{}, right{};
    Index half_edge = no_index;
    ViewKind kind = ViewKind::Site;
};

[[nodiscard]] inline Vec2 direction(const std::array<float, 2>& d) {
    return {static_cast<double>(d[0]), static_cast<double>(d[1])};
}
[[nodiscard]] inline std::array<float, 2> rounded(const Vec2& d) {
    return {static_cast<float>(d.x()), static_cast<float>(d.y())};
}

[[nodiscard]] inline double cross_product(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}
//! Turned by the angle of b and stretched by its length.
[[nodiscard]] inline Vec2 turned(const Vec2& a, const Vec2& b) {
    return {a.x() * b.x() - a.y() * b.y(), a.x() * b.y() + a.y() * b.x()};
}
//! Turned back by the angle of b, and stretched by its length.
[[nodiscard]] inline Vec2 turned_back(const Vec2& a, const Vec2& b) {
    return {a.x() * b.x() + a.y() * b.y(), a.y() * b.x() - a.x() * b.y()};
}

}  // namespace agvd
