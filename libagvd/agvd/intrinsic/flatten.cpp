#include "agvd/intrinsic/flatten.h"

#include <algorithm>
#include <cmath>

#include "agvd/intrinsic/vertex_operations.h"
#include "agvd/mesh/one_ring.h"

namespace agvd::detail {
namespace {

constexpr double angle_tolerance = 1e-10;
constexpr int most_steps = 60;
// The share of the range of factors that is left out at both ends: faces there are nearly
// degenerate.
constexpr double margin = 1e-3;

// With edges scaled by s the corner between a and b across from c has the cosine p - q w, w = 1/s².
struct Corner {
    double p, q;
};

struct Angle {
    double value, slope;
};

Angle angle_at(const std::vector<Corner>& corners, double w) {
    Angle sum{0, 0};
    for (const auto& [p, q] : corners) {
        const double cosine = std::clamp(p - q * w, -1.0, 1.0);
        sum.value += std::acos(cosine);
        sum.slope += q / std::sqrt(std::max(1 - cosine * cosine, 1e-300));
    }
    return sum;
}

// The angle grows with w. Newton's method is used, and bisection where a step would leave the
// range.
double solve(const std::vector<Corner>& corners, double target, double low, double high) {
    double w = std::clamp(1.0, low, high);
    for (int step = 0; step < most_steps; ++step) {
        const Angle angle = angle_at(corners, w);
        const double excess = angle.value - target;
        if (std::abs(excess) < angle_tolerance) break;
        (excess > 0 ? high : low) = w;
        const double next = w - excess / angle.slope;
        w = next > low && next < high ? next : (low + high) / 2;
    }
    return w;
}

}  // namespace

double cone_angle(const Surface& surface, Index vertex) {
    double sum = 0;
    for_each_outgoing(surface, vertex, [&](Index h) {
        sum += std::atan2(surface.apex[h].y(), surface.apex[h].x());
    });
    return sum;
}

bool flatten(Surface& surface, FaceCharts& charts, Index vertex, double target) {
    std::vector<Corner> corners;
    double low = 0, high = std::numeric_limits<double>::infinity();
    for_each_outgoing(surface, vertex, [&](Index h) {
        const double a = surface.length_of(h), b = surface.length_of(Surface::previous(h));
        const double c = surface.length_of(Surface::next(h));
        corners.push_back({(a * a + b * b) / (2 * a * b), c * c / (2 * a * b)});
        low = std::max(low, (a - b) * (a - b) / (c * c));
        high = std::min(high, (a + b) * (a + b) / (c * c));
    });
    const double left_out = margin * (high - low);
    low += left_out;
    high -= left_out;
    if (!(low < high) || angle_at(corners, low).value > target ||
        angle_at(corners, high).value < target) {
        return false;
    }
    const double scale = 1 / std::sqrt(solve(corners, target, low, high));
    for_each_outgoing(surface, vertex, [&](Index h) {
        surface.length[surface.edge[h]] *= scale;
        const Index back = Surface::previous(h);
        if (surface.twin[back] == no_index) surface.length[surface.edge[back]] *= scale;
    });
    for_each_outgoing(surface, vertex,
                      [&](Index h) { renew_face(surface, charts, Surface::face(h)); });
    return true;
}

}  // namespace agvd::detail
