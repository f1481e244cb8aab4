// A vertex is a corner if both the polyline and longer chords turn sharply there, so that noise
// makes none; or, at a lower angle, if it is on the boundary and that is straight around it, as a
// polygon is. (Creases are close to others; more nodes on them gave plates twice as many needles.)
#include "remesh/curves/curve_network.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "agvd/mesh/surface_points.h"

namespace remesh {
namespace {

constexpr double least_turn = std::numbers::pi / 4 - 1e-6;  // Rounding.
// Between straight sides: leaving out such a corner costs a distance of .1 spacings. The same angle
// as of weak creases.
constexpr double least_polygon_turn = 25 * degree;
// In spacings: the length of these sides, and as a share of the corner's turn theirs.
constexpr double side_length = 1, most_side_turn = 0.5;
// In spacings: length of a corner's chords, and least distance between corners.
constexpr double corner_reach = 0.5;

double turn(const Vec3& before, const Vec3& here, const Vec3& after) {
    return angle_between(here - before, after - here);
}

// The edge at a position of the curve, and the share of the edge before that position.
std::pair<std::size_t, double> find_position(const Curve& curve, double along) {
    const double length = curve.length();
    along = curve.is_closed() ? along - std::floor(along / length) * length
                              : std::clamp(along, 0.0, length);
    const auto& up_to = curve.up_to;
    const auto after = std::upper_bound(up_to.begin() + 1, up_to.end() - 1, along);
    const auto i = static_cast<std::size_t>(after - up_to.begin()) - 1;
    return {i, share_before(along, up_to[i], up_to[i + 1])};
}

// A curve as a polyline in space.
class Course {
public:
    Course(const Surface& surface, const Curve& curve) : curve_(curve) {
        for (std::size_t i = 0; i <= curve.num_edges(); ++i) {
            at_.push_back(surface.mesh.positions[curve.vertex(surface, i)]);
        }
    }

    [[nodiscard]] double turn_at(std::size_t i) const {
        return turn(at_[i == 0 ? curve_.num_edges() - 1 : i - 1], at_[i], at_[i + 1]);
    }
    // The smaller of two turns at an inner vertex, of its edges and of its chords; of a polygon's
    // corner the former. 0: it is no corner.
    // \param i  turns by least_polygon_turn or more.
    [[nodiscard]] double sharpness(std::size_t i, double spacing) const {
        const double here_turn = turn_at(i);
        const double reach = std::min(corner_reach * spacing, curve_.length() / 3);
        const double along = curve_.up_to[i];
        const double of_both =
            std::min(here_turn, turn(position(along - reach), at_[i], position(along + reach)));
        if (of_both >= least_turn) return of_both;
        if (curve_.sides.size() > 1) return 0;
        return has_straight_sides(i, here_turn, side_length * spacing) ? here_turn : 0;
    }

private:
    [[nodiscard]] bool has_straight_sides(std::size_t i, double here_turn, double length) const {
        const std::size_t num_edges = curve_.num_edges();
        double sum = 0;
        for (const bool is_after : {true, false}) {
            double way = 0;
            for (std::size_t j = i;;) {
                if (!curve_.is_closed() && j == (is_after ? num_edges : 0)) break;
                const std::size_t edge = is_after ? j : (j + num_edges - 1) % num_edges;
                way += curve_.up_to[edge + 1] - curve_.up_to[edge];
                if (way >= length) break;
                j = is_after ? j + 1 : edge;
                if (curve_.is_closed()) j %= num_edges;
                if (j == i) return false;
                if (curve_.is_closed() || (j > 0 && j < num_edges)) sum += turn_at(j);
                if (sum > most_side_turn * here_turn) return false;
            }
        }
        return true;
    }
    [[nodiscard]] Vec3 position(double along) const {
        const auto [i, share] = find_position(curve_, along);
        return (1 - share) * at_[i] + share * at_[i + 1];
    }

    const Curve& curve_;
    std::vector<Vec3> at_;  // By vertex of the curve.
};

}  // namespace

Curve curve_of_loop(const Surface& surface, std::vector<Index> loop) {
    Curve curve;
    curve.up_to.reserve(loop.size() + 1);
    curve.up_to.push_back(0);
    for (const Index h : loop) curve.up_to.push_back(curve.up_to.back() + surface.length_of(h));
    curve.sides.push_back({std::move(loop)});
    return curve;
}

std::vector<std::size_t> corners_of_curve(const Surface& surface, const Curve& curve,
                                          double spacing, const UnitAt& unit_at) {
    const auto spacing_at = [&](std::size_t i) {
        return unit_at ? spacing * unit_at(point_at(surface, curve.vertex(surface, i))) : spacing;
    };
    const Course course(surface, curve);
    std::vector<std::pair<double, std::size_t>> candidates;  // (minus sharpness, vertex)
    for (std::size_t i = curve.is_closed() ? 0 : 1; i < curve.num_edges(); ++i) {
        if (course.turn_at(i) < least_polygon_turn) continue;
        const double sharp = course.sharpness(i, spacing_at(i));
        if (sharp > 0) candidates.emplace_back(-sharp, i);
    }
    std::sort(candidates.begin(), candidates.end());
    std::vector<std::size_t> corners;
    const auto is_free = [&](std::size_t i) {
        const double at = curve.up_to[i], reach = corner_reach * spacing_at(i);
        if (!curve.is_closed() && std::min(at, curve.length() - at) < reach) return false;
        return std::none_of(corners.begin(), corners.end(), [&](std::size_t corner) {
            const double apart = std::abs(at - curve.up_to[corner]);
            const double around = curve.is_closed() ? curve.length() - apart : apart;
            return std::min(apart, around) < reach;
        });
    };
    for (const auto& [sharp, i] : candidates) {
        if (is_free(i)) corners.push_back(i);
    }
    std::sort(corners.begin(), corners.end());
    return corners;
}

Index node_at(const CurveNetwork& network, Index vertex) {
    const auto node = std::lower_bound(network.nodes.begin(), network.nodes.end(), vertex);
    if (node != network.nodes.end() && *node == vertex) {
        return static_cast<Index>(node - network.nodes.begin());
    }
    const auto copy =
        std::lower_bound(network.copies.begin(), network.copies.end(), std::pair(vertex, Index{0}));
    return copy != network.copies.end() && copy->first == vertex ? copy->second : no_index;
}

Index Curve::vertex(const Surface& surface, std::size_t i, std::size_t side) const {
    const bool is_last = i == num_edges();
    const Index h = sides[side].half_edges[is_last ? i - 1 : i];
    return is_last == sides[side].runs_along ? surface.head(h) : surface.tail(h);
}

SurfacePoint point_on_curve(const Curve& curve, double along, std::size_t side) {
    auto [i, share] = find_position(curve, along);
    if (!curve.sides[side].runs_along) share = 1 - share;
    return point_on(curve.sides[side].half_edges[i], share);
}

Vec3 tangent_of_curve(const Surface& surface, const Curve& curve, double along) {
    const std::size_t i = find_position(curve, along).first;
    const auto& p = surface.mesh.positions;
    const CurveSide& side = curve.sides.front();
    const Index h = side.half_edges[i];
    const Vec3 way = p[surface.head(h)] - p[surface.tail(h)];
    return (side.runs_along ? way : Vec3(-way)).normalized();
}

}  // namespace remesh
