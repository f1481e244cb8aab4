#include "support/points.h"

#include <algorithm>

#include "agvd/core/random.h"

namespace points {

using namespace agvd;

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

SurfacePoint anywhere(Dice& dice, Index face) {
    SurfacePoint point{FaceId(face), {}};
    for (double& b : point.barycentric) b = dice.number(0.01, 1);
    const Index corner = dice.count(0, 2);
    const double little = dice.one_in(4) ? dice.magnitude(1e-18, 1e-2) : 0;
    const Index kind = dice.count(0, 2);
    if (kind >= 1) point.barycentric[corner] *= little;
    if (kind == 2) point.barycentric[(corner + 1) % 3] *= little;
    const double sum = point.barycentric[0] + point.barycentric[1] + point.barycentric[2];
    for (double& b : point.barycentric) b /= sum;
    return point;
}

std::vector<SurfacePoint> random_sites(Dice& dice, Index num_faces) {
    constexpr Index most_sites = 120;
    Index count = 1;
    switch (dice.count(0, 4)) {
        case 0:
            break;
        case 1:
            count = dice.count(2, 4);
            break;
        case 2:
        case 3:
            count = dice.count(4, 20);
            break;
        default:  // More than faces, on small meshes.
            count = std::min(most_sites, num_faces + dice.count(1, 9));
    }
    std::vector<SurfacePoint> sites;
    while (sites.size() < count) {
        const Index face = !sites.empty() && dice.one_in(4) ? sites.back().face.value()
                                                            : dice.count(0, num_faces - 1);
        sites.push_back(anywhere(dice, face));
        if (sites.size() < count && dice.one_in(10)) sites.push_back(sites.back());
    }
    return sites;
}

}  // namespace points
