#include "agvd/intrinsic/charts.h"

namespace agvd::detail {

// The direction of a side in the first chart of a face, whose x axis is side 0. It is computed from
// the angles, since the difference of two long sides has few digits of a short one.
Vec2 FaceCharts::direction(Index half_edge) const {
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

FaceChart& FaceCharts::of(Index face) {
    if (!has(face)) set(face, peek(face));
    return entries_[slot_[face]].chart;
}

FaceChart FaceCharts::peek(Index face) const {
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
            chart.turn[k] = conjugate(entries_[slot_[Surface::face(twin)]].chart.turn[twin % 3]);
        } else {
            chart.turn[k] = turned_by(along, conjugate(-direction(twin))).normalized();
        }
    }
    return chart;
}

void FaceCharts::set(Index face, const FaceChart& chart) {
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

void FaceCharts::forget(Index face) {
    if (!has(face)) return;
    entries_[slot_[face]].face = no_index;
    free_.push_back(slot_[face]);
    slot_[face] = no_index;
}

void FaceCharts::take(const FaceCharts& part) {
    for (const Entry& entry : part.entries_) {
        if (entry.face == no_index) continue;
        slot_[entry.face] = static_cast<Index>(entries_.size());
        entries_.push_back(entry);
    }
}

void FaceCharts::renew(Index face) {
    if (!has(face)) return;
    FaceChart& chart = entries_[slot_[face]].chart;
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

void FaceCharts::share_turns(Index face) {
    const FaceChart& chart = entries_[slot_[face]].chart;
    for (Index k = 0; k < 3; ++k) {
        const Index twin = surface_.twin[3 * face + k];
        if (twin == no_index || !has(Surface::face(twin))) continue;
        entries_[slot_[Surface::face(twin)]].chart.turn[twin % 3] = conjugate(chart.turn[k]);
    }
}

}  // namespace agvd::detail
