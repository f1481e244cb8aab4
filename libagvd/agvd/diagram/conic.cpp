// The ray from a focus f in the direction u meets the branch at one point. With c from f to the
// other focus and D = (weight there) - (weight here), it is at
//   r = (|c|^2 - D^2) / (2 (u . c - D)).
#include "agvd/diagram/conic.h"

#include <cmath>

namespace agvd {

Vec2 Conic::gradient(const Vec2& p) const {
    return (p - focus[0]).normalized() - (p - focus[1]).normalized();
}

bool Conic::is_line() const {
    constexpr double rounding = 1e-13;
    const double apart = (focus[1] - focus[0]).norm();
    const double difference = std::abs(weight[1] - weight[0]);
    const double scale = rounding * (apart + std::abs(weight[0]) + std::abs(weight[1]));
    return difference <= scale || difference >= apart - scale;
}

std::optional<Vec2> Conic::on_ray(std::size_t k, const Vec2& direction) const {
    const Vec2 across = focus[1 - k] - focus[k];
    const double excess = weight[1 - k] - weight[k];
    const Vec2 along = direction.normalized();
    const double reach =
        (across.squaredNorm() - excess * excess) / (2 * (along.dot(across) - excess));
    if (!(reach >= 0 && reach < infinity)) return {};
    return focus[k] + reach * along;
}

Vec2 Conic::moved_onto(const Vec2& p) const {
    constexpr int most_steps = 8;
    // Gradients shorter than this are rounding: the foci lie in one direction.
    constexpr double least_gradient = 1e-12;
    Vec2 best = p;
    double least = gap(p);
    for (int i = 0; i < most_steps && least != 0; ++i) {
        const Vec2 slope = gradient(best);
        const double norm_sq = slope.squaredNorm();
        if (!(norm_sq > least_gradient * least_gradient)) break;
        const Vec2 next = best - least / norm_sq * slope;
        const double then = gap(next);
        if (!(std::abs(then) < std::abs(least))) break;
        best = next;
        least = then;
    }
    return best;
}

Vec2 Conic::between(const Vec2& from, const Vec2& to, double share) const {
    const Vec2 on_chord = (1 - share) * from + share * to;
    const Vec2 chord = to - from;
    if (is_line()) return moved_onto(on_chord);
    // From the focus that sees the chord from the side.
    const auto height = [&](std::size_t k) {
        return std::abs(cross(chord, (on_chord - focus[k]).normalized()));
    };
    const std::size_t k = height(0) > height(1) ? 0 : 1;
    const std::optional<Vec2> seen = on_ray(k, on_chord - focus[k]);
    const bool is_near = seen && (*seen - on_chord).norm() <= 2 * chord.norm();
    return moved_onto(is_near ? *seen : on_chord);
}

double Conic::most_stray(const Vec2& from, const Vec2& to) const {
    // The part lies in the triangle of the chord and the tangents, which are perpendicular to
    // gradients.
    const Vec2 first = gradient(from), last = gradient(to), chord = to - from;
    const double turn = std::abs(cross(first, last));
    if (turn == 0) return 0;
    if (!(first.dot(last) > 0)) return infinity;
    return std::abs(first.dot(chord) * last.dot(chord)) / (turn * chord.norm());
}

}  // namespace agvd
