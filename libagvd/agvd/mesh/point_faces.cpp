#include "agvd/mesh/point_faces.h"

#include <algorithm>

namespace agvd {
namespace {

constexpr double at_vertex = 1e-12;      // A share of the edge length.
constexpr double edge_rounding = 1e-12;  // A share of the height of the face.
constexpr double on_edge_slope = 1e-3;   // A share of the position along the edge.

}  // namespace

std::optional<Index> vertex_of(const Surface& surface, const SurfacePoint& point) {
    const std::optional<Index> corner = corner_of(surface, point);
    return corner ? std::optional(surface.tail(*corner)) : std::nullopt;
}

std::optional<Index> corner_of(const Surface& surface, const SurfacePoint& point) {
    const auto& b = point.barycentric;
    for (Index k = 0; k < 3; ++k) {
        const double to_next = b[(k + 1) % 3], to_last = b[(k + 2) % 3];
        // A quick test without the edges' lengths.
        if (to_next + to_last > at_vertex) continue;
        const Index h = 3 * point.face.value() + k;
        if (to_next == 0 && to_last == 0) return h;
        const double next = surface.length_of(h), last = surface.length_of(Surface::previous(h));
        if (to_next * next + to_last * last <= at_vertex * std::min(next, last)) return h;
    }
    return std::nullopt;
}

std::optional<Index> half_edge_of(const SurfacePoint& point) {
    const auto& b = point.barycentric;
    for (Index k = 0; k < 3; ++k) {
        const double height = b[(k + 2) % 3];
        const double along = std::min(b[k], b[(k + 1) % 3]);
        if (along > 0 && height <= std::min(edge_rounding, on_edge_slope * along)) {
            return 3 * point.face.value() + k;
        }
    }
    return std::nullopt;
}

SurfacePoint across_edge(const Surface& surface, const SurfacePoint& point, Index half_edge) {
    const Index twin = surface.twin[half_edge];
    SurfacePoint result{FaceId(Surface::face(twin)), {0, 0, 0}};
    result.barycentric[twin % 3] = point.barycentric[(half_edge + 1) % 3];
    result.barycentric[(twin + 1) % 3] = point.barycentric[half_edge % 3];
    return result;
}

std::optional<SurfacePoint> seen_from(const Surface& surface, const SurfacePoint& point,
                                      Index face) {
    if (point.face.value() == face) return point;
    std::optional<SurfacePoint> seen;
    for_each_view(surface, point, [&](const SurfacePoint& view) {
        if (!seen && view.face.value() == face) seen = view;
    });
    return seen;
}

CommonFaces common_faces(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    CommonFaces found;
    for_each_view(surface, a, [&](const SurfacePoint& view) {
        const Index face = view.face.value();
        if (face == found.first || found.second != no_index) return;
        if (!seen_from(surface, b, face)) return;
        (found.first == no_index ? found.first : found.second) = face;
    });
    return found;
}

bool is_on_boundary(const Surface& surface, const SurfacePoint& point) {
    if (const auto vertex = vertex_of(surface, point)) return surface.is_boundary_vertex(*vertex);
    const auto half_edge = half_edge_of(point);
    return half_edge && surface.twin[*half_edge] == no_index;
}

SurfacePoint point_at(const Surface& surface, Index vertex) {
    const Index h = surface.outgoing[vertex];
    SurfacePoint point{FaceId(Surface::face(h)), {0, 0, 0}};
    point.barycentric[h % 3] = 1;
    return point;
}

Vec2 position_in_frame(const Surface& surface, const SurfacePoint& point, Index half_edge) {
    assert(Surface::face(half_edge) == point.face.value());
    const Index k = half_edge % 3;
    const double head = point.barycentric[(k + 1) % 3];
    const double apex = point.barycentric[(k + 2) % 3];
    return apex * surface.apex[half_edge] + Vec2(head * surface.length_of(half_edge), 0);
}

}  // namespace agvd
