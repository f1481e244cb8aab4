// The scale is found by the secant method on the logarithms of scale and area, which is a straight
// line but for bounds and gradation.
#include "remesh/sites/target_lengths.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "agvd/core/portable_math.h"
#include "agvd/mesh/surface.h"
#include "remesh/sites/size_field.h"

namespace remesh {
namespace {

constexpr int most_tries = 12;
// Relative error of the area at which the search ends. The rest is one factor.
constexpr double area_tolerance = 5e-3;
// Longest edge where nothing bounds it, in mean edges: flat parts would get one of their own size.
constexpr double longest_of_mean = 4;
// Paths in a Delaunay triangulation (Paths::Lines) are up to 1.17 times as long as geodesics on
// tori; the rest is for the factor at the end.
constexpr double path_excess = 1.25;
// How fast targets may fall beside long edges that stay: by half from one row of triangles to the
// next.
constexpr double fall_near_least = 0.5;

// Calls each(other end, length) for the straight lines from a vertex across the opposite edges.
template <typename Each>
void for_each_line_across(const Surface& surface, Index vertex, const Each& each) {
    for_each_outgoing(surface, vertex, [&](Index h) {
        const Index opposite = Surface::next(h), twin = surface.twin[opposite];
        if (twin == no_index) return;
        // In the frame of the opposite edge, whose twin runs the other way.
        const Vec2 here = surface.apex[opposite], across = surface.apex[twin];
        const double length = surface.length_of(opposite);
        const Vec2 there(length - across.x(), -across.y());
        const double share = here.y() / (here.y() - there.y());
        const double crossing = here.x() + share * (there.x() - here.x());
        if (crossing < 0 || crossing > length) return;
        each(surface.tail(Surface::previous(twin)), (there - here).norm());
    });
}

struct LengthSearch {
    const Surface& surface;
    std::span<const double> values, most;
    std::span<const std::pair<Index, Index>> joined;
    const Sizing& sizing;
    double area;
    Ticker& ticker;
    double slope = portable::log(sizing.gradation) / path_excess;
    double mean = std::sqrt(surface_area(surface) / (area > 0 ? area : 1));
    double longest = sizing.is_adaptive() && area > 0
                         ? std::min(sizing.max_edge, longest_of_mean* mean)
                         : sizing.max_edge;
    std::vector<double> lower = {}, upper = {};  // #V; empty: there are no such bounds.

    // What targets must not fall below, and what they must not exceed even so.
    void find_bounds(std::span<const double> least) {
        // The growth of the difference from a length above all is limited.
        double highest = *std::max_element(least.begin(), least.end());
        // Beside edges much longer than the others hardly any vertex would be left for these.
        if (area > 0) highest = std::min(highest, longest_of_mean * mean);
        const double above = 2 * highest;
        for (const double length : least) lower.push_back(above - std::min(length, highest));
        limit_growth(surface, joined, fall_near_least, Paths::Lines, lower, ticker);
        for (double& length : lower) length = above - length;
        upper.assign(most.begin(), most.end());
        if (!upper.empty()) limit_growth(surface, joined, slope, Paths::Lines, upper, ticker);
    }

    std::vector<double> run() const {
        if (area == 0) return finished(at(1));
        double scale = first_scale(), steepness = -2;
        std::vector<double> best = at(scale);
        double error = error_of(best);
        double previous_scale = 0, previous_error = 0;
        for (int i = 1; i < most_tries && std::abs(error) > area_tolerance; ++i) {
            if (i > 1 && scale != previous_scale) {
                steepness = std::clamp(
                    (error - previous_error) / portable::log(scale / previous_scale), -4.0, -0.2);
            }
            previous_scale = scale;
            previous_error = error;
            scale *= portable::exp(-error / steepness);
            best = at(scale);
            error = error_of(best);
        }
        best = finished(std::move(best));
        const double factor = portable::exp(error_of(best) / 2);
        for (double& length : best) length *= factor;
        return best;
    }

private:
    [[nodiscard]] std::vector<double> bounded(std::vector<double> lengths) const {
        for (std::size_t v = 0; v < lower.size(); ++v) {
            lengths[v] = std::max(lengths[v], lower[v]);
            if (!upper.empty()) lengths[v] = std::min(lengths[v], upper[v]);
        }
        return lengths;
    }

    // Without bounds and gradation the area is in proportion to 1 / scale^2.
    [[nodiscard]] double first_scale() const {
        double sum = 0, whole = 0;
        for (Index f = 0; f < surface.num_faces(); ++f) {
            const double of_face = face_area(surface, f);
            whole += of_face;
            for (const Index v : surface.mesh.triangles[f]) {
                const double length = wanted(v, 1);
                sum += of_face / 3 / (length * length);
            }
        }
        return std::sqrt((sum > 0 ? sum : whole) / area);
    }

    [[nodiscard]] double wanted(Index v, double scale) const {
        if (const auto* largest = std::get_if<MaxError>(&sizing.count)) {
            return length_for_error(std::numbers::sqrt2 * values[v], largest->error);
        }
        if (sizing.is_adaptive()) return scale / portable::pow(values[v], 1. / 3);
        if (std::holds_alternative<VertexDensities>(sizing.edges)) {
            return scale / std::sqrt(values[v]);
        }
        return scale * values[v];
    }

    [[nodiscard]] std::vector<double> at(double scale) const {
        std::vector<double> result;
        result.reserve(values.size());
        for (Index v = 0; v < values.size(); ++v) {
            const double most_here = most.empty() ? longest : std::min(longest, most[v]);
            result.push_back(std::max(std::min(wanted(v, scale), most_here), sizing.min_edge));
        }
        limit_growth(surface, joined, slope, Paths::Edges, result, ticker);
        return result;
    }

    // The search measures along edges only, which is quicker and changes the area little.
    [[nodiscard]] std::vector<double> finished(std::vector<double> lengths) const {
        limit_growth(surface, joined, slope, Paths::Lines, lengths, ticker);
        return bounded(std::move(lengths));
    }

    // The logarithm of the area over that wanted.
    [[nodiscard]] double error_of(const std::vector<double>& lengths) const {
        return portable::log(area_in_lengths(surface, bounded(lengths)) / area);
    }
};

}  // namespace

double gradation_for(double slope) { return portable::exp(slope * path_excess); }

double length_for_error(double curvature, double error) {
    if (!(curvature > 0)) return infinity;
    const double radius = std::max(1 / curvature, error);
    return std::sqrt(3 * error * (2 * radius - error));
}

// The result is the least sum over all paths, whatever the order.
void limit_growth(const Surface& surface, std::span<const std::pair<Index, Index>> joined,
                  double slope, Paths paths, std::span<double> length, Ticker& ticker) {
    std::vector<std::pair<Index, Index>> copies;  // Each pair in both orders, sorted.
    for (const auto& [a, b] : joined) {
        copies.emplace_back(a, b);
        copies.emplace_back(b, a);
    }
    std::sort(copies.begin(), copies.end());
    const auto spread = [&](Index v, const auto& wait) {
        ticker.tick(4);
        const double here = length[v];
        const auto reach = [&](Index other, double way) {
            if (!(here + slope * way < length[other])) return;
            length[other] = here + slope * way;
            wait(other);
        };
        for (auto copy = std::lower_bound(copies.begin(), copies.end(), std::pair(v, Index{0}));
             copy != copies.end() && copy->first == v; ++copy) {
            reach(copy->second, 0);
        }
        for_each_edge_at(surface, v,
                         [&](Index h, Index other) { reach(other, surface.length_of(h)); });
        if (paths == Paths::Lines) for_each_line_across(surface, v, reach);
    };
    std::vector<Index> all(length.size());
    std::iota(all.begin(), all.end(), Index{0});
    visit_in_rounds(surface.num_vertices(), std::move(all), spread);
}

std::vector<double> target_lengths(const Surface& surface, std::span<const double> values,
                                   std::span<const double> most,
                                   std::span<const std::pair<Index, Index>> joined,
                                   const Sizing& sizing, double area, Ticker& ticker,
                                   std::span<const double> least) {
    LengthSearch search{surface, values, most, joined, sizing, area, ticker};
    if (!least.empty()) search.find_bounds(least);
    return search.run();
}

}  // namespace remesh
