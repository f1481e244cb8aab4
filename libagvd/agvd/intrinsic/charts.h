//! \file
//! Faces laid out in planes, and the rotations between the planes of neighbours. Private.
#pragma once

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
//! Lengths alone would suffice in exact arithmetic; in double, a few flips raise the error of a far
//! corner to a power. Directions let errors add up and not multiply (docs/algorithm/intrinsic.md).
class FaceCharts {
public:
    //! \param surface  outlives this; faces without a chart have not changed in it.
    explicit FaceCharts(const Surface& surface)
        : surface_(surface), own_slot_(surface.num_faces(), no_index), slot_(own_slot_) {}
    FaceCharts(const FaceCharts&) = delete;
    FaceCharts& operator=(const FaceCharts&) = delete;
    ~FaceCharts() = default;

    //! Charts of old faces that have none here. Threads may fill several parts, of different faces,
    //! as long as nothing else is done with the whole but to take() them.
    [[nodiscard]] FaceCharts part() { return FaceCharts(surface_, slot_); }
    //! Takes over the charts of a part, which is of no more use.
    void take(const FaceCharts& part) {
        for (const Entry& entry : part.entries_) {
            if (entry.face == no_index) continue;
            slot_[entry.face] = static_cast<Index>(entries_.size());
            entries_.push_back(entry);
        }
    }

    //! The chart of a face, which is made if there is none. Other charts may move in memory.
    FaceChart& of(Index face) {
        if (!has(face)) set(face, peek(face));
        return entries_[slot_[face]].chart;
    }

    //! The chart that of() would return, without storing a new one.
    [[nodiscard]] FaceChart peek(Index face) const {
        if (has(face)) return entries_[slot_[face]].chart;
        FaceChart chart;
        for (Index k = 0; k < 3; ++k) {
            const Index h = 3 * face + k;
            const Index twin = surface_.twin[h];
            const Vec2 along = direction(h);
            chart.side[k] = surface_.length_of(h) * along;
            if (twin == no_index) {
                chart.turn[k] = {1, 0};
            } else if (has(Surface::face(twin))) {
                chart.turn[k] =
                    conjugate(entries_[slot_[Surface::face(twin)]].chart.turn[twin % 3]);
            } else {
                chart.turn[k] = turned_by(along, conjugate(-direction(twin))).normalized();
            }
        }
        return chart;
    }

    //! Adds or replaces the chart of a face.
    void set(Index face, const FaceChart& chart) {
        if (face >= slot_.size()) slot_.resize(surface_.num_faces(), no_index);
        Index& slot = slot_[face];
        if (slot == no_index && free_.empty()) {
            slot = static_cast<Index>(entries_.size());
            entries_.push_back({face, chart});
            return;
        }
        if (slot == no_index) {
            slot = free_.back();
            free_.pop_back();
        }
        entries_[slot] = {face, chart};
    }

    //! Makes a chart again after its lengths have changed, with its neighbours' turns: charts
    //! across its sides know the directions that it had.
    void renew(Index face) {
        FaceChart& chart = of(face);
        for (Index k = 0; k < 3; ++k) {
            chart.side[k] = surface_.length_of(3 * face + k) * direction(3 * face + k);
        }
        for (Index k = 0; k < 3; ++k) {
            const Index twin = surface_.twin[3 * face + k];
            if (twin == no_index) continue;
            const Index across = Surface::face(twin);
            const Vec2 along =
                has(across) ? entries_[slot_[across]].chart.side[twin % 3] : direction(twin);
            chart.turn[k] = turned_by(chart.side[k], -conjugate(along)).normalized();
        }
        share_turns(face);
    }

    //! Updates the turns of the neighbours from those of a face, which has a chart.
    void share_turns(Index face) {
        const FaceChart& chart = entries_[slot_[face]].chart;
        for (Index k = 0; k < 3; ++k) {
            const Index twin = surface_.twin[3 * face + k];
            if (twin == no_index || !has(Surface::face(twin))) continue;
            entries_[slot_[Surface::face(twin)]].chart.turn[twin % 3] = conjugate(chart.turn[k]);
        }
    }

    //! Removes the chart of a face that was removed.
    void forget(Index face) {
        if (!has(face)) return;
        entries_[slot_[face]].face = no_index;
        free_.push_back(slot_[face]);
        slot_[face] = no_index;
    }

private:
    struct Entry {
        Index face;  // no_index: free.
        FaceChart chart;
    };

    FaceCharts(const Surface& surface, std::vector<Index>& slot) : surface_(surface), slot_(slot) {}
    [[nodiscard]] bool has(Index face) const {
        return face < slot_.size() && slot_[face] != no_index;
    }
    // The direction of a side in the first chart of a face, whose x axis is side 0. It is computed
    // from the angles, since the difference of two long sides has few digits of a short one.
    [[nodiscard]] Vec2 direction(Index half_edge) const {
        const Index first = half_edge - half_edge % 3;
        switch (half_edge % 3) {
            case 0:
                return {1, 0};
            case 1:
                return -conjugate(surface_.apex[first + 1].normalized());
            default:
                return -surface_.apex[first].normalized();
        }
    }

    const Surface& surface_;
    std::vector<Index> own_slot_;
    std::vector<Index>& slot_;  // By face: its entry; no_index: none. Parts use that of the whole.
    std::vector<Entry> entries_;
    std::vector<Index> free_;  // Entries.
};

}  // namespace agvd::detail
