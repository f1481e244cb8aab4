#include "agvd/intrinsic/base_history.h"

#include "agvd/mesh/face_area.h"

namespace agvd::detail {
namespace {

// Longer ways back are left to samples.
constexpr Index most_steps_back = 16, most_part_steps = 64;

// Fans of triangles around the first corner; areas in shares of the face.
InputPart measure(const FacePolygon& polygon) {
    const auto& corner = polygon.corner;
    InputPart part{{FaceId(polygon.face), {0, 0, 0}}, 0};
    for (Index i = 2; i < polygon.num_corners; ++i) {
        const double share = (corner[i - 1][1] - corner[0][1]) * (corner[i][2] - corner[0][2]) -
                             (corner[i - 1][2] - corner[0][2]) * (corner[i][1] - corner[0][1]);
        part.share += share;
        for (std::size_t k = 0; k < 3; ++k) {
            part.centroid.barycentric[k] +=
                share * (corner[0][k] + corner[i - 1][k] + corner[i][k]) / 3;
        }
    }
    for (double& b : part.centroid.barycentric) b = part.share > 0 ? b / part.share : 1.0 / 3;
    return part;
}

using Carry = void (FaceHistory::*)(const FaceSegment&, std::vector<FaceSegment>&) const;

void carry(const FaceHistory& first, const FaceHistory& second, Carry way,
           const FaceSegment& segment, std::vector<FaceSegment>& parts) {
    std::vector<FaceSegment> between;
    (first.*way)(segment, between);
    for (const FaceSegment& part : between) (second.*way)(part, parts);
}

}  // namespace

bool is_flat_in_space(const Surface& surface, Index face) {
    constexpr double rounding = 1e-9;  // Of a side.
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        if (!(surface.length_in_space(h) > (1 - rounding) * surface.length_of(h))) return false;
    }
    return true;
}

void BaseHistory::end_removal(const Surface& reduced, Ticker& ticker) {
    removal.shrink();
    flips = FaceHistory(reduced.num_faces());
    flat_area_.assign(reduced.num_faces(), 0);
    for (Index f = 0; f < reduced.num_faces(); ++f) {
        ticker.tick();
        if (!removal.is_changed(f) || !is_flat_in_space(reduced, f)) continue;
        flat_area_[f] = face_area(reduced, f);
    }
}

void BaseHistory::forward(const FaceSegment& segment, std::vector<FaceSegment>& parts) const {
    carry(removal, flips, &FaceHistory::forward, segment, parts);
}

void BaseHistory::backward(const FaceSegment& segment, std::vector<FaceSegment>& parts) const {
    carry(flips, removal, &FaceHistory::backward, segment, parts);
}

bool BaseHistory::parts_of(const Surface& input, Index face, std::vector<InputPart>& parts) const {
    constexpr double third = 1.0 / 3;
    SurfacePoint middle{FaceId(face), {third, third, third}};
    Index steps_back = most_steps_back;
    if (!flips.pass_back(middle, steps_back)) return false;
    if (!is_flat(middle.face.value()) && !removal.pass_back(middle, steps_back)) return false;
    Index steps = most_part_steps;
    std::vector<FacePolygon> reduced, whole;
    if (!flips.parts_of(FacePolygon(face), steps, reduced)) return false;
    const std::size_t before = parts.size();
    for (const FacePolygon& polygon : reduced) {
        if (is_flat(polygon.face)) {
            InputPart part = measure(polygon);
            part.centroid = removal.backward(part.centroid);
            const Index plane = part.centroid.face.value();
            part.share *= flat_area_[polygon.face] / face_area(input, plane);
            if (part.share > 0) parts.push_back(part);
            continue;
        }
        whole.clear();
        if (!removal.parts_of(polygon, steps, whole)) {
            parts.resize(before);
            return false;
        }
        for (const FacePolygon& one : whole) {
            const InputPart part = measure(one);
            if (part.share > 0) parts.push_back(part);
        }
    }
    return true;
}

}  // namespace agvd::detail
