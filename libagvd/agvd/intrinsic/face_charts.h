//! \file
//! Faces laid out in planes, and the rotations between the planes of neighbours. Private to
//! intrinsic.
#pragma once

#include <array>
#include <vector>

#include "agvd/mesh/surface.h"

namespace agvd::detail {

//! Products of these as complex numbers turn one by the other.
[[nodiscard]] inline Vec2 turned_by(const Vec2& v, const Vec2& turn) {
    return {v.x() * turn.x() - v.y() * turn.y(), v.x() * turn.y() + v.y() * turn.x()};
}
[[nodiscard]] inline Vec2 conjugate(const Vec2& v) { return {v.x(), -v.y()}; }

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
//! power: on a part of 14 740 needles lengths were wrong by 1e-3. Charts store directions besides
//! lengths, so that errors add up and do not multiply: 1e-13 there.
class FaceCharts {
public:
    //! \param surface  outlives this; faces without a chart have not changed in it.
    explicit FaceCharts(const Surface& surface) : surface_(surface), place_(own_place_) {}
    //! Charts of faces that have none in `whole`. That must not change until it takes the part
    //! over. Threads may fill several parts, of different faces.
    struct Part {
        FaceCharts& whole;
    };
    explicit FaceCharts(Part part) : surface_(part.whole.surface_), place_(part.whole.place_) {}
    FaceCharts(const FaceCharts&) = delete;
    FaceCharts& operator=(const FaceCharts&) = delete;
    ~FaceCharts() = default;

    //! To be called before there are parts, since threads must not reallocate what they share.
    void make_places() { place_.resize(surface_.num_faces(), no_index); }
    //! Takes over the charts of a part.
    void take(const FaceCharts& part);

    [[nodiscard]] bool has(Index face) const {
        return face < place_.size() && place_[face] != no_index;
    }
    void reserve(std::size_t num_faces) { charts_.reserve(num_faces); }
    //! The chart of a face, which is made if there is none. Other charts may move in memory.
    FaceChart& of(Index face);
    //! The chart that of() would return, without storing a new one.
    [[nodiscard]] FaceChart peek(Index face) const {
        return has(face) ? charts_[place_[face]] : first_chart(face);
    }
    //! Adds the chart of a new face, which has the highest number.
    void add(Index face, const FaceChart& chart);
    //! Replaces the chart of a face.
    void set(Index face, const FaceChart& chart);
    //! Makes the chart of a face again after its lengths have changed, and updates the turns of its
    //! neighbours.
    void renew(Index face);
    //! Updates the turns of the neighbours from those of a face.
    //! \param face  has a chart.
    void share_turns(Index face);
    //! Removes the chart of a face that was removed.
    void forget(Index face);

private:
    [[nodiscard]] Vec2 direction(Index half_edge) const;
    [[nodiscard]] FaceChart first_chart(Index face) const;

    const Surface& surface_;
    std::vector<Index> own_place_;
    std::vector<Index>& place_;  // By face; no_index: none. A part uses the array of the whole.
    std::vector<FaceChart> charts_;
    std::vector<Index> face_of_;  // By place; no_index: free.
    std::vector<Index> free_;     // Places.
};

}  // namespace agvd::detail
