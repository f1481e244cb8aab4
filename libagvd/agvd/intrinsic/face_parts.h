//! \file
//! Segments and polygons in one face. Private to intrinsic.
#pragma once

#include <algorithm>
#include <array>

#include "agvd/mesh/surface_point.h"

namespace agvd::detail {

//! A part of a polyline that lies in one face.
struct FaceSegment {
    SurfacePoint begin;
    SurfacePoint end;  //!< Of the same face.
};

//! A convex part of a face.
struct FacePolygon {
    static constexpr Index most_corners = 12;

    Index face = no_index;
    Index num_corners = 0;
    std::array<std::array<double, 3>, most_corners> corner;  //!< Barycentric, counter-clockwise.

    FacePolygon() = default;
    //! A whole face.
    explicit FacePolygon(Index whole) : face(whole), num_corners(3) {
        for (std::size_t k = 0; k < 3; ++k) {
            corner[k] = {0, 0, 0};
            corner[k][k] = 1;
        }
    }
    //! Copies the corners in use: few polygons have all.
    FacePolygon(const FacePolygon& other) : face(other.face), num_corners(other.num_corners) {
        std::copy_n(other.corner.begin(), num_corners, corner.begin());
    }
    FacePolygon& operator=(const FacePolygon& other) {
        face = other.face;
        num_corners = other.num_corners;
        std::copy_n(other.corner.begin(), num_corners, corner.begin());
        return *this;
    }
    ~FacePolygon() = default;
};

}  // namespace agvd::detail
