//! \file
//! Faces laid out in planes, and the rotations between the planes of neighbours. Private.
#pragma once

#include <unordered_map>

#include "agvd/mesh/surface.h"

namespace agvd::detail {

//! Products of these as complex numbers turn one by the other.
[[nodiscard]] inline Vec2 turned_by(const Vec2& v, const Vec2& turn) {
    return {v.x() * turn.x() - v.y() * turn.y(), v.x() * turn.y() + v.y() * turn.x()};
}
[[nodiscard]] inline Vec2 conjugate(const Vec2& v) { return {v.x(), -v.y()}; }
[[nodiscard]] inline double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

//! A face in a plane of its own.
struct FaceChart {
    std::array<Vec2, 3> side;  //!< From corner k to corner k + 1.
    //! Unit vectors: turn vectors of the chart across side k into this one. Unused on the boundary.
    std::array<Vec2, 3> turn;
};

//! Charts of the faces that operations have changed.
//!
//! Lengths alone would suffice in exact arithmetic. In double, a far corner computed from a short
//! side has an error of a rounding times the ratio of the two, and a few flips raise that to a
//! power. Charts store directions besides lengths, so that errors add up and do not multiply
//! (docs/algorithm.md, "Charts").
class FaceCharts {
public:
    //! \param surface  outlives this; faces without a chart have not changed in it.
    explicit FaceCharts(const Surface& surface) : surface_(surface) {}

    //! The chart of a face, which is made if there is none.
    FaceChart& of(Index face);
    //! The chart that of() would return, without storing a new one.
    [[nodiscard]] FaceChart peek(Index face) const;
    //! Adds or replaces the chart of a face.
    void set(Index face, const FaceChart& chart) { charts_.insert_or_assign(face, chart); }
    //! Makes the chart of a face again after its lengths have changed, and updates the turns of its
    //! neighbours.
    void renew(Index face);
    //! Updates the turns of the neighbours from those of a face, which has a chart.
    void share_turns(Index face);
    //! Removes the chart of a face that was removed.
    void forget(Index face) { charts_.erase(face); }
    //! Takes over charts of faces that have none here.
    void take(FaceCharts& others) { charts_.merge(others.charts_); }

private:
    [[nodiscard]] const FaceChart* find(Index face) const;
    [[nodiscard]] Vec2 direction(Index half_edge) const;

    const Surface& surface_;
    std::unordered_map<Index, FaceChart> charts_;  // By face.
};

}  // namespace agvd::detail
