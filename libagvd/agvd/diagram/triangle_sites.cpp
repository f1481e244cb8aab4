#include "agvd/diagram/triangle_sites.h"

#include <algorithm>
#include <limits>

namespace agvd {
namespace {

// Height over the side from corner k to k + 1.
double signed_height(const TriangleSites& triangle, const Vec2& p, std::size_t k) {
    const Vec2& a = triangle.corners[k];
    const Vec2& b = triangle.corners[(k + 1) % 3];
    const double length = (b - a).norm();
    return length > 0 ? cross(b - a, p - a) / length : 0;
}

}  // namespace

double longest_side(const std::array<Vec2, 3>& corners) {
    return std::sqrt(
        std::max({(corners[1] - corners[0]).squaredNorm(), (corners[2] - corners[1]).squaredNorm(),
                  (corners[0] - corners[2]).squaredNorm()}));
}

Relays relays_of_site(const TriangleSites& triangle, Index site) {
    for (const TriangleSites::Group& group : triangle.groups) {
        if (group.site == site) return group.relays;
    }
    return {};
}

double outside(const TriangleSites& triangle, const Vec2& p) {
    double least = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2& a = triangle.corners[k];
        if (cross(triangle.corners[(k + 1) % 3] - a, p - a) < 0) {
            least = std::min(least, signed_height(triangle, p, k));
        }
    }
    return -least;
}

Vec2 moved_inside(const TriangleSites& triangle, const Vec2& p) {
    const auto& corners = triangle.corners;
    const Vec2 centroid = (corners[0] + corners[1] + corners[2]) / 3;
    double keep = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const double at_p = signed_height(triangle, p, k);
        const double at_centroid = signed_height(triangle, centroid, k);
        if (at_p < 0 && at_centroid > 0) {
            keep = std::min(keep, at_centroid / (at_centroid - at_p));
        }
    }
    return centroid + keep * (p - centroid);
}

double undercut(const TriangleSites& triangle, const Vec2& p, double distance,
                std::span<const Index> sites) {
    double least = distance;
    for (const TriangleSites::Group& group : triangle.groups) {
        if (std::find(sites.begin(), sites.end(), group.site) != sites.end()) continue;
        least = std::min(least, least_reach(group.relays, p).distance);
    }
    return distance - least;
}

const PlanarRelay* nearest_relay(Relays relays, const Vec2& p) {
    const PlanarRelay* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const PlanarRelay& relay : relays) {
        const double distance = reach(relay, p).distance;
        if (distance < least) {
            least = distance;
            best = &relay;
        }
    }
    return best;
}

}  // namespace agvd
