//! \file
//! The targets that a Steiner point serves across its edge: a filter like the simplified windows of
//! [meng2021].
#pragma once

#include <algorithm>
#include <cmath>

#include "agvd/core/types.h"

namespace agvd {

//! Targets [begin, end) on the far side of a face, numbered counter-clockwise: 1 to m are the
//! points on the next half-edge, m + 1 is the apex, and from m + 2 on the points on the previous
//! half-edge follow.
struct TargetRange {
    Index begin;
    Index end;
};

//! A face in the frame of one of its half-edges. The m points on each of the two other sides divide
//! it into m + 1 intervals.
struct FarSide {
    double length;  //!< Of the half-edge.
    Vec2 apex;
    Index next_intervals;
    Index previous_intervals;

    //! Where a ray upwards from the base meets the far side, in target numbers (real).
    [[nodiscard]] double target_at(const Vec2& origin, const Vec2& direction) const {
        const double run = apex.y() * direction.x() / direction.y();
        if (run < apex.x() - origin.x()) {  // The apex lies to the right: the previous half-edge.
            const double shift =
                static_cast<double>(next_intervals) - static_cast<double>(previous_intervals);
            return previous_intervals * (2 - origin.x() / (apex.x() - run)) + shift;
        }
        return next_intervals * (length - origin.x()) / (run - apex.x() + length);
    }

    //! The targets in the strip of straight lines from the window of `parent`, below the base, to
    //! the window of `here`, on the base. Both windows extend by one spacing to either side.
    //! \param spacing         of the points on the base.
    //! \param parent_spacing  from the parent to its neighbour on its own edge, up to sign.
    [[nodiscard]] TargetRange visible_targets(const Vec2& here, double spacing, const Vec2& parent,
                                              const Vec2& parent_spacing) const {
        const Vec2 ahead = here - parent;
        const bool is_left = ahead.x() * parent_spacing.y() - ahead.y() * parent_spacing.x() > 0;
        const Vec2 turn = Vec2(spacing, 0) + (is_left ? -parent_spacing : parent_spacing);
        const Vec2 right = ahead + turn;
        const Vec2 left = ahead - turn;
        const double all = static_cast<double>(next_intervals) + previous_intervals;
        const double first = right.y() > 0 ? target_at(here, right) : 0;
        const double last = left.y() > 0 ? target_at(here, left) : all;
        return {static_cast<Index>(std::max(0.0, std::floor(first))),
                static_cast<Index>(std::min(all, std::ceil(last))) + 1};
    }
};

}  // namespace agvd
