#include "remesh/dual/face_strip.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "agvd/mesh/point_faces.h"

namespace remesh {

using agvd::Index;
using agvd::no_index;
using agvd::Surface;
using agvd::SurfacePoint;

namespace {

bool has_corner(const Surface& surface, Index face, Index vertex) {
    const agvd::Triangle& t = surface.mesh.triangles[face];
    return t[0] == vertex || t[1] == vertex || t[2] == vertex;
}

// The half-edge of `face` that leaves `vertex`.
Index leaving(const Surface& surface, Index face, Index vertex) {
    const agvd::Triangle& t = surface.mesh.triangles[face];
    return 3 * face + (t[0] == vertex ? 0U : t[1] == vertex ? 1U : 2U);
}

// The edge of its face with these ends has the point on it.
bool is_on(const SurfacePoint& point, Index half_edge) {
    return point.barycentric[(half_edge + 2) % 3] == 0;
}

}  // namespace

void cross(const Surface& surface, Index half_edge, std::vector<Index>& crossed) {
    assert(surface.twin[half_edge] != no_index);
    if (!crossed.empty() && crossed.back() == surface.twin[half_edge]) {
        crossed.pop_back();
    } else {
        crossed.push_back(half_edge);
    }
}

FaceStrip reversed(const Surface& surface, const FaceStrip& strip) {
    FaceStrip result{strip.target, strip.source, {}};
    result.crossed.reserve(strip.crossed.size());
    for (auto h = strip.crossed.rbegin(); h != strip.crossed.rend(); ++h) {
        result.crossed.push_back(surface.twin[*h]);
    }
    return result;
}

FaceStrip joined(const Surface& surface, const FaceStrip& first, const FaceStrip& second) {
    return StripBuilder(surface, first).finish(second);
}

SurfacePoint snapped(const Surface& surface, const SurfacePoint& point) {
    SurfacePoint result = point;
    auto& b = result.barycentric;
    if (const std::optional<Index> vertex = vertex_of(surface, point)) {
        b = {0, 0, 0};
        b[leaving(surface, point.face.value(), *vertex) % 3] = 1;
    } else if (const std::optional<Index> h = half_edge_of(point)) {
        b[(*h + 2) % 3] = 0;
        const double sum = b[*h % 3] + b[(*h + 1) % 3];
        b[*h % 3] /= sum;
        b[(*h + 1) % 3] = 1 - b[*h % 3];
    }
    return result;
}

void trim(const Surface& surface, FaceStrip& strip) {
    std::vector<Index>& crossed = strip.crossed;
    auto first = crossed.begin();
    for (; first != crossed.end() && is_on(strip.source, *first); ++first) {
        strip.source = across_edge(surface, strip.source, *first);
    }
    crossed.erase(crossed.begin(), first);
    while (!crossed.empty() && is_on(strip.target, surface.twin[crossed.back()])) {
        strip.target = across_edge(surface, strip.target, surface.twin[crossed.back()]);
        crossed.pop_back();
    }
}

bool holds(const Surface& surface, Index face, const SurfacePoint& point) {
    if (point.face.value() == face) return true;
    const auto& b = point.barycentric;
    if (b[0] != 0 && b[1] != 0 && b[2] != 0) return false;
    return agvd::seen_from(surface, point, face).has_value();
}

StripBuilder::StripBuilder(const Surface& surface, const SurfacePoint& source)
    : StripBuilder(surface, FaceStrip{source, source, {}}) {}

StripBuilder::StripBuilder(const Surface& surface, FaceStrip strip)
    : surface_(surface),
      strip_(std::move(strip)),
      face_(strip_.target.face.value()),
      pivot_(strip_.target) {}

void StripBuilder::to_vertex(Index vertex) {
    turn_to([&](Index face) { return has_corner(surface_, face, vertex); });
    pivot_ = point_at(surface_, vertex);
}

void StripBuilder::to_face(Index face) {
    turn_to([&](Index f) { return f == face; });
}

FaceStrip StripBuilder::finish(const SurfacePoint& target) {
    turn_to([&](Index face) { return holds(surface_, face, target); });
    strip_.target = *agvd::seen_from(surface_, target, face_);
    return std::move(strip_);
}

FaceStrip StripBuilder::finish(const FaceStrip& onwards) {
    pivot_ = onwards.source;
    to_face(onwards.source.face.value());
    for (const Index h : onwards.crossed) cross(surface_, h, strip_.crossed);
    strip_.target = onwards.target;
    return std::move(strip_);
}

// Turns around the pivot the shorter way.
template <typename IsGoal>
void StripBuilder::turn_to(const IsGoal& is_goal) {
    if (is_goal(face_)) return;
    const std::optional<Index> vertex = vertex_of(surface_, pivot_);
    if (!vertex) {
        for (Index h = 3 * face_; h < 3 * face_ + 3; ++h) {
            const Index twin = surface_.twin[h];
            if (twin == no_index || !is_goal(Surface::face(twin))) continue;
            cross(surface_, h, strip_.crossed);
            face_ = Surface::face(twin);
            return;
        }
        assert(false);
        return;
    }
    // One step each way in turn, so that the way found is the shorter one.
    const Index start = leaving(surface_, face_, *vertex);
    Index left = start, right = start;  // They leave the vertex; no_index: at the boundary.
    for (Index steps = 1;; ++steps) {
        if (left != no_index) left = surface_.twin[Surface::previous(left)];
        if (right != no_index) right = surface_.twin[right];
        if (right != no_index) right = Surface::next(right);
        const bool is_left = left != no_index && is_goal(Surface::face(left));
        const bool is_right = right != no_index && is_goal(Surface::face(right));
        if (is_left || is_right) {
            Index h = start;
            for (Index i = 0; i < steps; ++i) {
                const Index out = is_left ? Surface::previous(h) : h;
                cross(surface_, out, strip_.crossed);
                h = is_left ? surface_.twin[out] : Surface::next(surface_.twin[out]);
            }
            face_ = Surface::face(h);
            return;
        }
        const bool is_around = left == start || (left == no_index && right == no_index);
        assert(!is_around);
        if (is_around) return;
    }
}

}  // namespace remesh
