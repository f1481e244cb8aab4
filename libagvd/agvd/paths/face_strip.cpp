// StripBuilder turns around the current point, from face to face, if it is a vertex or on an edge.
#include "agvd/paths/face_strip.h"

#include <cassert>
#include <optional>
#include <string>

#include "agvd/mesh/surface_points.h"

namespace agvd {

namespace {

// The view of a point in the face of `from` that is nearest to `from`; nothing if there is none.
std::optional<SurfacePoint> nearest_view(const Surface& surface, const SurfacePoint& point,
                                         const SurfacePoint& from) {
    std::optional<SurfacePoint> nearest;
    double least = infinity;
    for_each_view(surface, point, [&](const SurfacePoint& view) {
        if (view.face != from.face) return;
        const double distance = face_distance(surface, from, view);
        if (!(distance < least)) return;
        least = distance;
        nearest = view;
    });
    return nearest;
}

// Whether the point lies on this half-edge of its face.
bool is_on(const SurfacePoint& point, Index half_edge) {
    return point.barycentric[(half_edge + 2) % 3] == 0;
}

class StripBuilder {
public:
    StripBuilder(const Surface& surface, const SurfacePoint& source)
        : surface_(surface), strip_{source, source, {}}, here_(source) {}

    // Continues to `next` in `face`; invalid: in any face that both share. If the face has it at
    // several points, the strip goes to the nearest. False if there is no such face.
    bool go_to(const SurfacePoint& next, FaceId face) {
        const bool is_found = turn_to([&](const SurfacePoint& view) {
            return face.is_valid() ? view.face == face
                                   : seen_from(surface_, next, view.face.value()).has_value();
        });
        const auto there =
            is_found ? nearest_view(surface_, next, here_) : std::optional<SurfacePoint>();
        if (there) here_ = *there;
        return there.has_value();
    }
    FaceStrip finish() {
        strip_.target = here_;
        return std::move(strip_);
    }

private:
    // Turns by the shorter way to a view that is the goal. False if there is none.
    template <typename IsGoal>
    bool turn_to(const IsGoal& is_goal) {
        if (is_goal(here_)) return true;
        const std::optional<Index> corner = corner_of(surface_, here_);
        if (!corner) {
            const std::optional<Index> h = half_edge_of(here_);
            if (!h || surface_.twin[*h] == no_index) return false;
            cross(surface_, *h, strip_.crossed);
            here_ = across_edge(surface_, here_, *h);
            return is_goal(here_);
        }
        // Alternates between both directions, so the way found is the shorter one.
        const Index start = *corner;
        Index left = start, right = start;  // Leaving the vertex; no_index: at the boundary.
        for (Index steps = 1;; ++steps) {
            if (left != no_index) left = surface_.twin[Surface::previous(left)];
            if (right != no_index) right = surface_.twin[right];
            if (right != no_index) right = Surface::next(right);
            const bool is_left = left != no_index && is_goal(point_on(left, 0));
            const bool is_right = right != no_index && is_goal(point_on(right, 0));
            if (is_left || is_right) {
                Index h = start;
                for (Index i = 0; i < steps; ++i) {
                    const Index out = is_left ? Surface::previous(h) : h;
                    cross(surface_, out, strip_.crossed);
                    h = is_left ? surface_.twin[out] : Surface::next(surface_.twin[out]);
                }
                here_ = point_on(h, 0);
                return true;
            }
            if (left == start || (left == no_index && right == no_index)) return false;
        }
    }

    const Surface& surface_;
    FaceStrip strip_;
    SurfacePoint here_;  // The current point, in the strip's last face.
};

}  // namespace

void cross(const Surface& surface, Index half_edge, std::vector<Index>& crossed) {
    assert(surface.twin[half_edge] != no_index);
    if (!crossed.empty() && crossed.back() == surface.twin[half_edge]) {
        crossed.pop_back();
    } else {
        crossed.push_back(half_edge);
    }
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

FaceStrip strip_along(const Surface& surface, std::span<const SurfacePoint> points,
                      std::span<const FaceId> faces) {
    if (points.empty()) throw InvalidInput("a path needs a point");
    StripBuilder builder(surface, snapped(surface, points.front()));
    for (std::size_t i = 1; i < points.size(); ++i) {
        const FaceId face = faces.empty() ? FaceId() : faces[i - 1];
        if (builder.go_to(snapped(surface, points[i]), face)) continue;
        throw InvalidInput("points " + std::to_string(i - 1) + " and " + std::to_string(i) +
                           " of a path share no face; add the points where it crosses edges");
    }
    return builder.finish();
}

}  // namespace agvd
