#include "agvd/mesh/uniform_points.h"

#include <algorithm>
#include <cmath>

#include "agvd/core/random.h"
#include "agvd/mesh/face_area.h"

namespace agvd {

std::vector<SurfacePoint> uniform_points(const Surface& surface, Index count, std::uint64_t seed) {
    std::vector<double> area_up_to(surface.num_faces());
    double area = 0;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        area += face_area(surface, f);
        area_up_to[f] = area;
    }
    std::vector<SurfacePoint> points(area_up_to.empty() ? 0 : count);
    for (Index i = 0; i < points.size(); ++i) {
        const double share = random_unit(seed, 0, i) * area;
        const auto found = std::upper_bound(area_up_to.begin(), area_up_to.end(), share);
        const auto face = std::min(found - area_up_to.begin(), std::ssize(area_up_to) - 1);
        points[i] = {FaceId(static_cast<Index>(face)),
                     uniform_barycentric(1 - random_unit(seed, 1, i), random_unit(seed, 2, i))};
    }
    return points;
}

}  // namespace agvd
