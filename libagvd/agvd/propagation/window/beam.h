//! \file
//! Beams: parallel shortest paths from an edge of a line, where they cross an edge. They are what
//! windows are for points, with an image at infinity.
#pragma once

#include <algorithm>

#include "agvd/core/types.h"

namespace agvd {

//! The parallel paths through [begin, end] of a half-edge into its face. A point p in the frame of
//! the half-edge has distance weight - p u through the beam, with the unit vector u = (x, y)
//! towards the line, y < 0. The distance is exact; no beam is merged with another one.
struct Beam {
    double x, y;
    double weight;  //!< Distance of the half-edge's tail, or of its projection on the beam.
    double begin, end;
    Index half_edge;
    Index tail,
        head;  //!< Records of the half-edge's ends; of a free beam tail is the next free one.

    //! Of a point of the edge.
    [[nodiscard]] double distance(double at) const { return weight - at * x; }
    //! Least distance over the interval.
    [[nodiscard]] double nearest() const { return std::min(distance(begin), distance(end)); }
    //! From ray to ray.
    [[nodiscard]] double width() const { return (begin - end) * y; }
};

}  // namespace agvd
