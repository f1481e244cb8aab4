// The ray from a focus f through a point of the chord meets the branch at one point. With c from f
// to the other focus, D = (weight there) - (weight here) and u the direction of the ray, it is at
//   r = (|c|^2 - D^2) / (2 (u . c - D)).
// This is the way where Newton steps across the chord do not arrive.
#include "agvd/diagram/conic.h"

#include <cmath>

namespace agvd {
namespace {

constexpr int most_steps = 12;
// A share of the distances: gaps below it are rounding.
constexpr double equal_gaps = 1e-14;
// Gradients shorter than this are rounding: the foci lie in one direction.
constexpr double least_gradient = 1e-12;

// Steps along slope(p), as long as the gap falls.
template <typename Slope>
Vec2 newton(const Conic& conic, const Vec2& start, const Slope& slope) {
    Vec2 p = start;
    double gap = conic.gap(p);
    for (int i = 0; i < most_steps && gap != 0; ++i) {
        const Vec2 along = slope(p);
        const double norm_sq = along.squaredNorm();
        if (!(norm_sq > least_gradient * least_gradient)) break;
        const Vec2 next = p - gap / norm_sq * along;
        const double then = conic.gap(next);
        if (!(std::abs(then) < std::abs(gap))) break;
        p = next;
        gap = then;
    }
    return p;
}

}  // namespace

double Conic::gap(const Vec2& p) const {
    return ((p - focus[0]).norm() + weight[0]) - ((p - focus[1]).norm() + weight[1]);
}

Vec2 Conic::gradient(const Vec2& p) const {
    return (p - focus[0]).normalized() - (p - focus[1]).normalized();
}

bool Conic::is_line() const {
    constexpr double rounding = 1e-13;
    const double between = (focus[1] - focus[0]).norm();
    const double difference = std::abs(weight[1] - weight[0]);
    const double scale = rounding * (between + weight[0] + weight[1]);
    return difference <= scale || difference >= between - scale;
}

Vec2 Conic::on_ray(std::size_t from, const Vec2& direction) const {
    const Vec2 between = focus[1 - from] - focus[from];
    const double excess = weight[1 - from] - weight[from];
    const Vec2 along = direction.normalized();
    const double reach =
        (between.squaredNorm() - excess * excess) / (2 * (along.dot(between) - excess));
    return focus[from] + reach * along;
}

Vec2 Conic::moved_onto(const Vec2& start) const {
    return newton(*this, start, [&](const Vec2& p) { return gradient(p); });
}

Vec2 Conic::opposite(const Vec2& from, const Vec2& to, double share) const {
    const Vec2 on_chord = (1 - share) * from + share * to;
    const double length = (to - from).norm();
    if (!(length > 0)) return moved_onto(on_chord);
    const Vec2 normal = Vec2(from.y() - to.y(), to.x() - from.x()) / length;
    Vec2 across = newton(*this, on_chord,
                         [&](const Vec2& p) -> Vec2 { return normal.dot(gradient(p)) * normal; });
    const double rounding = equal_gaps * (weight[0] + (across - focus[0]).norm() + length);
    if (is_line() || std::abs(gap(across)) <= rounding) return across;
    // From the focus that sees the chord from the side.
    const auto height = [&](std::size_t i) {
        return std::abs(cross(to - from, (on_chord - focus[i]).normalized()));
    };
    const std::size_t k = height(0) > height(1) ? 0 : 1;
    const Vec2 seen = on_ray(k, on_chord - focus[k]);
    const bool is_near = (seen - on_chord).norm() <= 2 * length;  // False for what is not finite.
    return moved_onto(is_near ? seen : across);
}

}  // namespace agvd
