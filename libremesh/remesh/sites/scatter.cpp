#include "remesh/sites/scatter.h"

#include <algorithm>
#include <array>
#include <unordered_set>

#include "agvd/core/progress.h"
#include "agvd/core/random.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"

namespace remesh::detail {
namespace {

// \param sums  by face of the component: weight up to and with it.
SurfacePoint draw(const Component& component, const std::vector<double>& sums, double pick,
                  double u, double v) {
    const auto found = std::upper_bound(sums.begin(), sums.end(), pick * sums.back());
    const auto slot = std::min<std::ptrdiff_t>(found - sums.begin(),
                                               static_cast<std::ptrdiff_t>(sums.size()) - 1);
    const std::array<double, 3> uniform = uniform_barycentric(u, v);
    const auto inner = [](double b) { return interior_margin + (1 - 3 * interior_margin) * b; };
    const double b1 = inner(uniform[1]), b2 = inner(uniform[2]);
    return {FaceId(component.faces[static_cast<std::size_t>(slot)]), {1 - b1 - b2, b1, b2}};
}

// Weights with the highest density in each face; fewer points are accepted where it is lower.
std::vector<double> highest_weights(const Surface& surface, const Component& component,
                                    const SizeField& sizes) {
    std::vector<double> sums;
    double sum = 0;
    for (const Index f : component.faces) {
        const double least = sizes.least_in_face()[f];
        sum += face_area(surface, f) / (least * least);
        sums.push_back(sum);
    }
    return sums;
}

}  // namespace

std::vector<ScatteredPoint> scatter(const Surface& surface, const Component& component, Index count,
                                    std::uint64_t seed, std::uint64_t stream,
                                    const Progress& progress, const SizeField* sizes) {
    Poller poller(progress);
    Ticker ticker(poller);
    std::vector<ScatteredPoint> points;
    points.reserve(count);
    std::unordered_set<Vec3, PositionHash> taken;
    taken.reserve(count);
    // Usually one each.
    const std::uint64_t most_draws = (sizes != nullptr ? 1000 : 4) * std::uint64_t{count} + 64;
    const std::vector<double> weights =
        sizes != nullptr ? highest_weights(surface, component, *sizes) : component.area_up_to;
    for (std::uint64_t i = 0; points.size() < count && i < most_draws; ++i) {
        ticker.tick(4);
        const auto unit = [&](std::uint64_t k) { return random_unit(seed, stream, 3 * i + k); };
        const SurfacePoint point = draw(component, weights, unit(0), unit(1), unit(2));
        if (sizes != nullptr) {
            const double share = sizes->least_in_face()[point.face.value()] / sizes->at(point);
            if (random_unit(seed, ~stream, i) > share * share) continue;
        }
        const Vec3 where = position(surface.mesh.view(), point);
        if (taken.insert(where).second) points.push_back({point, where});
    }
    return points;
}

}  // namespace remesh::detail
