#include "agvd/metrics/common_face.h"

#include <algorithm>

namespace agvd {
namespace {

// Visits the faces that hold the point: one, the two at its edge, or all around its vertex.
template <typename Visit>
void for_each_face(const Surface& surface, const SurfacePoint& point, const Visit& visit) {
    const auto& b = point.barycentric;
    const Index first = 3 * point.face.value();
    const auto num_zero = std::count(b.begin(), b.end(), 0.0);
    if (num_zero == 2) {
        const auto corner = std::find_if(b.begin(), b.end(), [](double x) { return x != 0; });
        const Index v = surface.tail(first + static_cast<Index>(corner - b.begin()));
        for (Index h = surface.outgoing[v];;) {
            visit(Surface::face(h));
            h = surface.twin[Surface::previous(h)];
            if (h == no_index || h == surface.outgoing[v]) return;
        }
    }
    visit(point.face.value());
    if (num_zero == 0) return;
    const auto opposite = static_cast<Index>(std::find(b.begin(), b.end(), 0.0) - b.begin());
    const Index across = surface.twin[Surface::next(first + opposite)];
    if (across != no_index) visit(Surface::face(across));
}

}  // namespace

std::optional<SurfacePoint> seen_from(const Surface& surface, const SurfacePoint& point,
                                      Index face) {
    SurfacePoint seen{FaceId(face), {0, 0, 0}};
    const Triangle& from = surface.mesh.triangles[point.face.value()];
    const Triangle& to = surface.mesh.triangles[face];
    for (std::size_t k = 0; k < 3; ++k) {
        if (point.barycentric[k] == 0) continue;
        const auto corner = std::find(to.begin(), to.end(), from[k]) - to.begin();
        if (corner == 3) return std::nullopt;
        seen.barycentric[static_cast<std::size_t>(corner)] = point.barycentric[k];
    }
    return seen;
}

CommonFaces common_faces(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    CommonFaces found;
    for_each_face(surface, a, [&](Index face) {
        if (face == found.first || found.second != no_index) return;
        if (!seen_from(surface, b, face)) return;
        (found.first == no_index ? found.first : found.second) = face;
    });
    return found;
}

}  // namespace agvd
