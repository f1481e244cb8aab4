#include "remesh/sampling/scatter.h"

#include <algorithm>
#include <array>
#include <unordered_set>

#include "agvd/core/poller.h"
#include "agvd/core/position_hash.h"
#include "agvd/mesh/uniform_points.h"

namespace remesh::detail {
namespace {

using agvd::Index;

agvd::SurfacePoint draw(const Component& component, double pick, double u, double v) {
    const auto& sums = component.area_up_to;
    const auto found = std::upper_bound(sums.begin(), sums.end(), pick * component.area());
    const auto slot = std::min<std::ptrdiff_t>(found - sums.begin(),
                                               static_cast<std::ptrdiff_t>(sums.size()) - 1);
    const std::array<double, 3> uniform = agvd::uniform_barycentric(u, v);
    const auto inner = [](double b) { return interior_margin + (1 - 3 * interior_margin) * b; };
    const double b1 = inner(uniform[1]), b2 = inner(uniform[2]);
    return {agvd::FaceId(component.faces[static_cast<std::size_t>(slot)]), {1 - b1 - b2, b1, b2}};
}

}  // namespace

std::vector<ScatteredPoint> scatter(const agvd::Surface& surface, const Component& component,
                                    Index count, std::uint64_t seed, std::uint64_t stream,
                                    const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    agvd::Ticker ticker(poller);
    std::vector<ScatteredPoint> points;
    points.reserve(count);
    std::unordered_set<agvd::Vec3, agvd::PositionHash> taken;
    taken.reserve(count);
    const std::uint64_t most_draws = 4 * std::uint64_t{count} + 64;  // Usually one each.
    for (std::uint64_t i = 0; points.size() < count && i < most_draws; ++i) {
        ticker.tick(4);
        const auto unit = [&](std::uint64_t k) {
            return agvd::random_unit(seed, stream, 3 * i + k);
        };
        const agvd::SurfacePoint point = draw(component, unit(0), unit(1), unit(2));
        const agvd::Vec3 where = agvd::position(surface.mesh.view(), point);
        if (taken.insert(where).second) points.push_back({point, where});
    }
    return points;
}

}  // namespace remesh::detail
