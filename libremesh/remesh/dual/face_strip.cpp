// A strip is a list of crossed half-edges. StripBuilder appends to it by turning around the current
// point, from face to face, if that is a vertex or lies on an edge. A view of a point is its place
// in one of the faces that have it.
#include "remesh/dual/face_strip.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <optional>

#include "agvd/mesh/surface_points.h"

namespace remesh {

namespace {

// The view of a point in the face of `from` that is nearest to `from`; nothing if there is none.
std::optional<SurfacePoint> nearest_view(const Surface& surface, const SurfacePoint& point,
                                         const SurfacePoint& from) {
    std::optional<SurfacePoint> nearest;
    double least = std::numeric_limits<double>::infinity();
    for_each_view(surface, point, [&](const SurfacePoint& view) {
        if (view.face != from.face) return;
        const double distance = face_distance(surface, from, view);
        if (!(distance < least)) return;
        least = distance;
        nearest = view;
    });
    return nearest;
}

bool has_corner(const Surface& surface, Index face, Index vertex) {
    const Triangle& t = surface.mesh.triangles[face];
    return t[0] == vertex || t[1] == vertex || t[2] == vertex;
}

// Whether the point lies on this half-edge of its face.
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
    if (const std::optional<Index> corner = corner_of(surface, point)) {
        b = {0, 0, 0};
        b[*corner % 3] = 1;
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
    return seen_from(surface, point, face).has_value();
}

StripBuilder::StripBuilder(const Surface& surface, const SurfacePoint& source)
    : StripBuilder(surface, FaceStrip{source, source, {}}) {}

StripBuilder::StripBuilder(const Surface& surface, FaceStrip strip)
    : surface_(surface), strip_(std::move(strip)), here_(strip_.target) {}

void StripBuilder::to_vertex(Index vertex) {
    turn_to(
        [&](const SurfacePoint& view) { return has_corner(surface_, view.face.value(), vertex); });
    here_ = *nearest_view(surface_, point_at(surface_, vertex), here_);
}

void StripBuilder::to_face(Index face) {
    turn_to([&](const SurfacePoint& view) { return view.face.value() == face; });
}

FaceStrip StripBuilder::finish(const SurfacePoint& target) {
    turn_to([&](const SurfacePoint& view) { return holds(surface_, view.face.value(), target); });
    strip_.target = *nearest_view(surface_, target, here_);
    return std::move(strip_);
}

// Turns to the corner or side where the other strip starts, and appends that strip.
FaceStrip StripBuilder::finish(const FaceStrip& onwards) {
    const SurfacePoint& start = onwards.source;
    const Index corner = corner_of(surface_, start).value_or(no_index);
    const Index side = half_edge_of(start).value_or(no_index);
    turn_to([&](const SurfacePoint& view) {
        if (view.face != start.face) return false;
        if (corner != no_index) return corner_of(surface_, view) == corner;
        return side == no_index || half_edge_of(view) == side;
    });
    for (const Index h : onwards.crossed) cross(surface_, h, strip_.crossed);
    strip_.target = onwards.target;
    return std::move(strip_);
}

// Turns around the current point, by the shorter way, to a view that is the goal.
template <typename IsGoal>
void StripBuilder::turn_to(const IsGoal& is_goal) {
    if (is_goal(here_)) return;
    const std::optional<Index> corner = corner_of(surface_, here_);
    if (!corner) {
        const std::optional<Index> h = half_edge_of(here_);
        assert(h && surface_.twin[*h] != no_index);
        if (!h || surface_.twin[*h] == no_index) return;
        cross(surface_, *h, strip_.crossed);
        here_ = across_edge(surface_, here_, *h);
        assert(is_goal(here_));
        return;
    }
    const auto at = [](Index leaving) {
        SurfacePoint view{FaceId(Surface::face(leaving)), {0, 0, 0}};
        view.barycentric[leaving % 3] = 1;
        return view;
    };
    // Alternates between both directions, so the way found is the shorter one.
    const Index start = *corner;
    Index left = start, right = start;  // Leaving the vertex; no_index: at the boundary.
    for (Index steps = 1;; ++steps) {
        if (left != no_index) left = surface_.twin[Surface::previous(left)];
        if (right != no_index) right = surface_.twin[right];
        if (right != no_index) right = Surface::next(right);
        const bool is_left = left != no_index && is_goal(at(left));
        const bool is_right = right != no_index && is_goal(at(right));
        if (is_left || is_right) {
            Index h = start;
            for (Index i = 0; i < steps; ++i) {
                const Index out = is_left ? Surface::previous(h) : h;
                cross(surface_, out, strip_.crossed);
                h = is_left ? surface_.twin[out] : Surface::next(surface_.twin[out]);
            }
            here_ = at(h);
            return;
        }
        const bool is_around = left == start || (left == no_index && right == no_index);
        assert(!is_around);
        if (is_around) return;
    }
}

}  // namespace remesh
