//! \file
//! Faces laid out in planes, and how the planes of neighbours are turned against each other.
//! Private to intrinsic.
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

//! Charts of the faces that operations have touched.
//!
//! Lengths alone would do in exact arithmetic. In double, a far corner seen from a short side is
//! off by a rounding times the ratio of the two, and a few flips raise that to a power: on a part
//! of 14 740 needles lengths were wrong by 1e-3. Charts keep directions besides lengths, so that
//! errors add up and do not multiply: 1e-13 there.
class FaceCharts {
public:
    //! \param surface  outlives this; a face without a chart is still as this shows it.
    explicit FaceCharts(const Surface& surface) : surface_(surface), place_(own_place_) {}
    //! Of faces that have none in `whole`, which must not change until it takes them over. Several
    //! may be filled side by side, of different faces.
    struct Part {
        FaceCharts& whole;
    };
    explicit FaceCharts(Part part) : surface_(part.whole.surface_), place_(part.whole.place_) {}
    FaceCharts(const FaceCharts&) = delete;
    FaceCharts& operator=(const FaceCharts&) = delete;
    ~FaceCharts() = default;

    //! Before there are parts: threads must not move what they share.
    void make_places() { place_.resize(surface_.num_faces(), no_index); }
    //! Takes over a part's charts.
    void take(const FaceCharts& part);

    [[nodiscard]] bool has(Index face) const {
        return face < place_.size() && place_[face] != no_index;
    }
    void reserve(std::size_t num_faces) { charts_.reserve(num_faces); }
    //! The face's chart, which is made if there is none. Others may move in memory.
    FaceChart& of(Index face);
    //! The chart that of() would hand out, without making one.
    [[nodiscard]] FaceChart peek(Index face) const {
        return has(face) ? charts_[place_[face]] : first_chart(face);
    }
    //! Gives a new face, which has the highest number, its chart.
    void add(Index face, const FaceChart& chart);
    //! Gives a face another chart.
    void set(Index face, const FaceChart& chart);
    //! Makes the face's chart anew where its lengths have changed, and tells those across.
    void renew(Index face);
    //! Tells the charts across a face's sides of its turns.
    //! \param face  has a chart.
    void share_turns(Index face);
    //! The face is gone: its place is for another.
    void forget(Index face);

private:
    [[nodiscard]] Vec2 direction(Index half_edge) const;
    [[nodiscard]] FaceChart first_chart(Index face) const;

    const Surface& surface_;
    std::vector<Index> own_place_;
    std::vector<Index>& place_;  // By face; no_index: none. A part's are in those of the whole.
    std::vector<FaceChart> charts_;
    std::vector<Index> face_of_;  // By place; no_index: free.
    std::vector<Index> free_;     // Places.
};

}  // namespace agvd::detail
