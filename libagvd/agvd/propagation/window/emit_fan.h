//! \file
//! Windows from a vertex into the faces around it.
#pragma once

#include <optional>

#include "agvd/propagation/window/front_state.h"

namespace agvd {

//! Directions around a vertex, counter-clockwise.
struct Fan {
    double distance;  //!< Of the vertex, from below: the path is longer by at most `error`.
    float error;
    Index first;  //!< Leaves the vertex; its face is the first one.
    Index last =
        no_index;  //!< The same of the last face; no_index: to the boundary, or all around.
    //! Rays that bound the fan in its first and last face, in the frames of `first` and `last`;
    //! none: the whole face.
    std::optional<Vec2> from = {}, to = {};
};

//! All directions at a vertex of a run.
[[nodiscard]] Fan fan_around(const FrontState& front, Index record);

//! Sends windows through the edges opposite to the vertex, and reaches the ends of these edges.
//! \return false if the boundary comes before the last face.
bool emit_fan(FrontState& front, const Fan& fan);

}  // namespace agvd
