#include "remesh/sampling/boundary_curves.h"

#include <algorithm>
#include <cmath>

#include "remesh/features/curve_network.h"

namespace remesh {

using agvd::Index;
using agvd::Surface;
using agvd::SurfacePoint;

std::vector<Index> find_corners(const Surface& surface, const std::vector<Index>& loop,
                                double spacing) {
    std::vector<Index> corners;
    for (const std::size_t i : corners_of_curve(surface, curve_of_loop(surface, loop), spacing)) {
        corners.push_back(surface.tail(loop[i]));
    }
    return corners;
}

std::vector<SurfacePoint> sample_loop(const Surface& surface, const std::vector<Index>& loop,
                                      const std::vector<Index>& corners, double spacing) {
    const Curve curve = curve_of_loop(surface, loop);
    std::vector<double> ends;  // Places on the loop where its pieces begin.
    for (std::size_t i = 0; i < loop.size() && ends.size() < corners.size(); ++i) {
        if (surface.tail(loop[i]) == corners[ends.size()]) ends.push_back(curve.up_to[i]);
    }
    if (ends.empty()) ends.push_back(0);
    // Least number of intervals of a piece, so that the loop gets three sites.
    const double fewest = std::ceil(3.0 / static_cast<double>(ends.size()));
    std::vector<SurfacePoint> sites;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const double begin = ends[i];
        const double end = i + 1 < ends.size() ? ends[i + 1] : ends[0] + curve.length();
        const auto intervals =
            static_cast<Index>(std::max(fewest, std::round((end - begin) / spacing)));
        for (Index k = 0; k < intervals; ++k) {
            sites.push_back(point_on_curve(curve, begin + (end - begin) * k / intervals));
        }
    }
    return sites;
}

}  // namespace remesh
