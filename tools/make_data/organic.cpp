// An octopus: limbs are chains of round cones along splines, blended where they meet. Four arms
// curl back into themselves, which makes four handles. The surface is a contour (contour.h) of the
// blended distance; an inversion makes face sizes vary.

#include <algorithm>
#include <cmath>
#include <limits>

#include "make_data/contour.h"
#include "make_data/data_files.h"
#include "make_data/formula.h"

namespace make_data {

using agvd::Vec2;
using agvd::Vec3;

namespace {

using Ball = Eigen::Vector4d;  // centre and radius

// A chain of balls, consecutive ones joined by round cones.
struct Limb {
    std::vector<Ball> balls;
    double width;                // over which it blends with the limbs before it
    std::vector<double> travel;  // #balls: the most by which the distance to a ball of the chain
                                 // can have changed since the first one

    Limb(std::vector<Ball> chain, double blend_width)
        : balls(std::move(chain)), width(blend_width) {
        travel.push_back(0);
        for (std::size_t i = 1; i < balls.size(); ++i) {
            const Ball step = balls[i] - balls[i - 1];
            travel.push_back(travel.back() + step.head<3>().norm() + std::abs(step.w()));
        }
    }
};

// Catmull-Rom through the knots, `steps` balls per span.
std::vector<Ball> spline(const std::vector<Ball>& knots, int steps) {
    std::vector<Ball> balls{knots.front()};
    const std::size_t last = knots.size() - 1;
    for (std::size_t i = 0; i < last; ++i) {
        const Ball &b = knots[i], &c = knots[i + 1];
        const Ball a = i > 0 ? knots[i - 1] : Ball(2 * b - c);
        const Ball d = i + 1 < last ? knots[i + 2] : Ball(2 * c - b);
        for (int k = 1; k <= steps; ++k) {
            const double t = static_cast<double>(k) / steps;
            balls.push_back(
                b +
                t / 2 * ((c - a) + t * ((2 * a - 5 * b + 4 * c - d) + t * (3 * (b - c) + d - a))));
        }
    }
    return balls;
}

// Of the round cone that two balls span: the distance to the ball between them that is closest.
double distance(const Ball& a, const Ball& b, const Vec3& p) {
    const Ball along = b - a;
    const Vec3 axis = along.head<3>(), from = p - a.head<3>();
    const double length_sq = axis.squaredNorm(), foot = from.dot(axis) / length_sq;
    const double side_sq = std::max(0.0, from.squaredNorm() - foot * foot * length_sq);
    const double lean = std::max(length_sq - along.w() * along.w(), 0.01 * length_sq);
    const double t = foot + along.w() * std::sqrt(side_sq / (length_sq * lean));
    const Ball closest = a + std::clamp(t, 0.0, 1.0) * along;
    return (p - closest.head<3>()).norm() - closest.w();
}

// The distance to a limb if that is below `limit`; skips balls that are too far away to matter.
double distance(const Limb& limb, const Vec3& p, double limit) {
    double best = limit;
    for (std::size_t i = 0; i + 1 < limb.balls.size();) {
        const Ball& ball = limb.balls[i];
        const double spare = (p - ball.head<3>()).norm() - ball.w() - best;
        const auto next =
            std::upper_bound(limb.travel.begin(), limb.travel.end(), limb.travel[i] + spare);
        const auto first = static_cast<std::size_t>(std::max<std::ptrdiff_t>(
            next - limb.travel.begin() - 1, static_cast<std::ptrdiff_t>(i)));
        if (first == i) best = std::min(best, distance(ball, limb.balls[i + 1], p));
        i = std::max(first, i + 1);
    }
    return best;
}

// The smaller of two distances, rounded off where they differ by less than `width`.
double blend(double a, double b, double width) {
    const double h = std::max(0.0, 1 - std::abs(a - b) / width);
    return std::min(a, b) - width / 6 * h * h * h;
}

// Knots of one arm: outwards, up, sideways; radius.
const std::vector<Ball> ring_arm{{0.10, 0.06, 0.00, 0.28},  {0.50, -0.22, 0.06, 0.24},
                                 {0.95, -0.44, 0.10, 0.19}, {1.40, -0.36, 0.04, 0.16},
                                 {1.64, 0.00, -0.06, 0.14}, {1.48, 0.36, -0.12, 0.13},
                                 {1.16, 0.38, -0.10, 0.12}, {0.98, 0.10, 0.00, 0.115},
                                 {1.02, -0.20, 0.08, 0.11}, {1.06, -0.42, 0.10, 0.105}};
const std::vector<Ball> free_arm{
    {0.10, 0.06, 0.00, 0.28},   {0.50, -0.24, -0.08, 0.24}, {0.95, -0.44, -0.16, 0.19},
    {1.35, -0.50, -0.10, 0.16}, {1.70, -0.48, 0.08, 0.14},  {2.02, -0.38, 0.20, 0.13},
    {2.20, -0.12, 0.18, 0.125}, {2.12, 0.16, 0.08, 0.12},   {1.88, 0.26, 0.0, 0.115}};

struct Arm {
    const std::vector<Ball>& knots;
    double turn, length, sway;  // direction seen from above; scale outwards and sideways
};

void add_arm(const Arm& arm, std::vector<Limb>& limbs) {
    constexpr int steps = 10;
    const Vec2 out = unit_circle(arm.turn);
    std::vector<Ball> knots;
    for (const Ball& k : arm.knots) {
        const double x = arm.length * k.x(), z = arm.sway * k.z();
        knots.emplace_back(x * out.x() - z * out.y(), k.y(), x * out.y() + z * out.x(), k.w());
    }
    // In two limbs, so that the end blends with the start where it comes back to it.
    const std::vector<Ball> balls = spline(knots, steps);
    const auto half = balls.begin() + 5 * steps;
    limbs.emplace_back(std::vector(balls.begin(), half + 1), 0.22);
    limbs.emplace_back(std::vector(half, balls.end()), 0.07);
}

std::vector<Limb> octopus() {
    std::vector<Limb> limbs;
    limbs.emplace_back(spline({{0.0, 0.02, 0.02, 0.36},
                               {0.0, 0.42, 0.04, 0.44},
                               {0.02, 0.92, -0.14, 0.66},
                               {0.06, 1.36, -0.46, 0.52},
                               {0.08, 1.60, -0.76, 0.26}},
                              16),
                       0.1);
    for (const Arm& arm : {Arm{ring_arm, 0.02, 1.0, 1.0}, Arm{free_arm, 0.16, 0.92, 1.2},
                           Arm{free_arm, 0.30, 0.84, -1.1}, Arm{ring_arm, 0.45, 1.05, -1.0},
                           Arm{free_arm, 0.56, 1.0, 1.3}, Arm{ring_arm, 0.69, 0.95, 1.2},
                           Arm{ring_arm, 0.81, 1.1, -1.0}, Arm{free_arm, 0.92, 1.06, 1.4}}) {
        add_arm(arm, limbs);
    }
    for (const double x : {-1.0, 1.0}) {
        limbs.emplace_back(
            std::vector<Ball>{{0.28 * x, 0.60, 0.26, 0.22}, {0.32 * x, 0.64, 0.32, 0.20}}, 0.14);
        limbs.emplace_back(
            std::vector<Ball>{{0.34 * x, 0.66, 0.40, 0.17}, {0.37 * x, 0.68, 0.44, 0.17}}, 0.08);
    }
    return limbs;
}

}  // namespace

agvd::TriangleMesh organic() {
    const std::vector<Limb> limbs = octopus();
    const Field field = [&](const Vec3& p) {
        double value = std::numeric_limits<double>::max();
        for (const Limb& limb : limbs) {
            value = blend(value, distance(limb, p, value + limb.width), limb.width);
        }
        return value;
    };
    // An inversion is conformal: cells stay regular while their size grows with the squared
    // distance from its centre.
    const Vec3 focus(0.6, -4.0, 3.2);
    ContourOptions options;
    options.place = [&](const Vec3& q) { return Vec3(focus + q / q.squaredNorm()); };
    const Vec3 inside = Vec3(0, 0.8, -0.2) - focus;
    options.inside = inside / inside.squaredNorm();
    options.spacing = 0.0025;
    options.jitter = 0.08;
    options.smoothing = 3;
    return contour(field, options);
}

}  // namespace make_data
