#include "agvd/intrinsic/face_charts.h"

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
    if (!has(face)) add(face, first_chart(face));
    return charts_[place_[face]];
}

FaceChart FaceCharts::first_chart(Index face) const {
    FaceChart chart;
    for (Index k = 0; k < 3; ++k) {
        const Index h = 3 * face + k;
        const Index twin = surface_.twin[h];
        const Vec2 along = direction(h);
        chart.side[k] = surface_.length_of(h) * along;
        if (twin == no_index) {
            chart.turn[k] = {1, 0};
        } else if (has(Surface::face(twin))) {
            chart.turn[k] = conjugate(charts_[place_[Surface::face(twin)]].turn[twin % 3]);
        } else {
            chart.turn[k] = turned_by(along, conjugate(-direction(twin))).normalized();
        }
    }
    return chart;
}

void FaceCharts::set(Index face, const FaceChart& chart) {
    if (has(face)) {
        charts_[place_[face]] = chart;
    } else {
        add(face, chart);
    }
}

void FaceCharts::add(Index face, const FaceChart& chart) {
    if (face >= place_.size()) place_.resize(surface_.num_faces(), no_index);
    if (free_.empty()) {
        place_[face] = static_cast<Index>(charts_.size());
        charts_.push_back(chart);
        face_of_.push_back(face);
    } else {
        place_[face] = free_.back();
        free_.pop_back();
        charts_[place_[face]] = chart;
        face_of_[place_[face]] = face;
    }
}

void FaceCharts::take(const FaceCharts& part) {
    for (std::size_t i = 0; i < part.charts_.size(); ++i) {
        if (part.face_of_[i] != no_index) add(part.face_of_[i], part.charts_[i]);
    }
}

void FaceCharts::forget(Index face) {
    if (!has(face)) return;
    face_of_[place_[face]] = no_index;
    free_.push_back(place_[face]);
    place_[face] = no_index;
}

void FaceCharts::renew(Index face) {
    if (!has(face)) return;
    FaceChart& chart = charts_[place_[face]];
    for (Index k = 0; k < 3; ++k) {
        chart.side[k] = surface_.length_of(3 * face + k) * direction(3 * face + k);
    }
    for (Index k = 0; k < 3; ++k) {
        const Index twin = surface_.twin[3 * face + k];
        if (twin == no_index) continue;
        const Index across = Surface::face(twin);
        const Vec2 along = has(across) ? charts_[place_[across]].side[twin % 3] : direction(twin);
        chart.turn[k] = turned_by(chart.side[k], -conjugate(along)).normalized();
    }
    share_turns(face);
}

void FaceCharts::share_turns(Index face) {
    const FaceChart& chart = charts_[place_[face]];
    for (Index k = 0; k < 3; ++k) {
        const Index twin = surface_.twin[3 * face + k];
        if (twin == no_index || !has(Surface::face(twin))) continue;
        charts_[place_[Surface::face(twin)]].turn[twin % 3] = conjugate(chart.turn[k]);
    }
}

}  // namespace agvd::detail
