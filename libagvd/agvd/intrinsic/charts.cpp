#include "agvd/intrinsic/charts.h"

namespace agvd::detail {

const FaceChart* FaceCharts::find(Index face) const {
    const auto found = charts_.find(face);
    return found == charts_.end() ? nullptr : &found->second;
}

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
    const auto found = charts_.find(face);
    return found == charts_.end() ? charts_.emplace(face, peek(face)).first->second : found->second;
}

FaceChart FaceCharts::peek(Index face) const {
    if (const FaceChart* const made = find(face)) return *made;
    FaceChart chart;
    for (Index k = 0; k < 3; ++k) {
        const Index h = 3 * face + k;
        const Index twin = surface_.twin[h];
        const Vec2 along = direction(h);
        chart.side[k] = surface_.length_of(h) * along;
        if (twin == no_index) {
            chart.turn[k] = {1, 0};
        } else if (const FaceChart* const across = find(Surface::face(twin))) {
            chart.turn[k] = conjugate(across->turn[twin % 3]);
        } else {
            chart.turn[k] = turned_by(along, conjugate(-direction(twin))).normalized();
        }
    }
    return chart;
}

void FaceCharts::renew(Index face) {
    const auto found = charts_.find(face);
    if (found == charts_.end()) return;
    FaceChart& chart = found->second;
    for (Index k = 0; k < 3; ++k) {
        chart.side[k] = surface_.length_of(3 * face + k) * direction(3 * face + k);
    }
    for (Index k = 0; k < 3; ++k) {
        const Index twin = surface_.twin[3 * face + k];
        if (twin == no_index) continue;
        const FaceChart* const across = find(Surface::face(twin));
        const Vec2 along = across != nullptr ? across->side[twin % 3] : direction(twin);
        chart.turn[k] = turned_by(chart.side[k], -conjugate(along)).normalized();
    }
    share_turns(face);
}

void FaceCharts::share_turns(Index face) {
    const FaceChart& chart = charts_.at(face);
    for (Index k = 0; k < 3; ++k) {
        const Index twin = surface_.twin[3 * face + k];
        if (twin == no_index) continue;
        const auto across = charts_.find(Surface::face(twin));
        if (across != charts_.end()) across->second.turn[twin % 3] = conjugate(chart.turn[k]);
    }
}

}  // namespace agvd::detail
