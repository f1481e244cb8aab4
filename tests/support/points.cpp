#include "support/points.h"

#include "agvd/core/random.h"

namespace points {

using namespace agvd;

SurfacePoint at_vertex(const Surface& surface, Index vertex) {
    const Index h = surface.outgoing[vertex];
    SurfacePoint point{FaceId(Surface::face(h)), {0, 0, 0}};
    point.barycentric[h % 3] = 1;
    return point;
}

std::vector<SurfacePoint> scattered(const Surface& surface, Index count, std::uint64_t seed) {
    std::vector<SurfacePoint> points;
    for (Index i = 0; i < count; ++i) {
        const auto random = [&](std::uint64_t k) { return random_unit(seed, k, i); };
        const auto face = static_cast<Index>(random(0) * surface.num_faces());
        std::array<double, 3> b{random(1), random(2), random(3)};
        const auto corner = static_cast<std::size_t>(random(4) * 3);
        if (i % 3 >= 1) b[corner] = 0;
        if (i % 3 == 2) b[(corner + 1) % 3] = 0;
        const double sum = b[0] + b[1] + b[2];
        points.push_back({FaceId(face), {b[0] / sum, b[1] / sum, b[2] / sum}});
    }
    return points;
}

}  // namespace points
