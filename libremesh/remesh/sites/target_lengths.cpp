// The scale is found by the secant method on the logarithms of scale and area, which is a straight
// line but for bounds and gradation.
#include "remesh/sites/target_lengths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "agvd/mesh/surface.h"
#include "remesh/sites/gradation.h"
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

class LengthSearch {
public:
    LengthSearch(const Surface& surface, std::span<const double> values,
                 std::span<const double> most, std::span<const std::pair<Index, Index>> joined,
                 const Sizing& sizing, double area, std::span<const double> least, Ticker& ticker)
        : surface_(surface),
          values_(values),
          most_(most),
          joined_(joined),
          sizing_(sizing),
          area_(area),
          ticker_(ticker),
          slope_(std::log(sizing.gradation) / path_excess) {
        const double real_area = surface_area(surface);
        mean_ = std::sqrt(real_area / (area > 0 ? area : 1));
        longest_ = sizing.max_edge;
        if (sizing.is_adaptive && area > 0) longest_ = std::min(longest_, longest_of_mean * mean_);
        if (!least.empty()) find_bounds(least);
    }

    TargetLengths run() {
        if (area_ == 0) return finished(at(1));
        double scale = first_scale(), slope = -2;
        TargetLengths best = at(scale);
        double error = error_of(best);
        double previous_scale = 0, previous_error = 0;
        for (int i = 1; i < most_tries && std::abs(error) > area_tolerance; ++i) {
            if (i > 1 && scale != previous_scale) {
                slope = std::clamp((error - previous_error) / std::log(scale / previous_scale),
                                   -4.0, -0.2);
            }
            previous_scale = scale;
            previous_error = error;
            scale *= std::exp(-error / slope);
            best = at(scale);
            error = error_of(best);
        }
        best = finished(std::move(best));
        const double factor = std::exp(error_of(best) / 2);
        for (double& length : best.length) length *= factor;
        return best;
    }

private:
    // What targets must not fall below, and what they must not exceed even so.
    void find_bounds(std::span<const double> least) {
        // The growth of the difference from a length above all is limited.
        double most = *std::max_element(least.begin(), least.end());
        // Beside edges much longer than the others hardly any vertex would be left for these.
        if (area_ > 0) most = std::min(most, longest_of_mean * mean_);
        const double above = 2 * most;
        for (const double length : least) lower_.push_back(above - std::min(length, most));
        limit_growth(surface_, joined_, fall_near_least, Paths::Lines, lower_, ticker_);
        for (double& length : lower_) length = above - length;
        upper_.assign(most_.begin(), most_.end());
        if (!upper_.empty()) {
            limit_growth(surface_, joined_, slope_, Paths::Lines, upper_, ticker_);
        }
    }

    // The lengths within these bounds.
    [[nodiscard]] std::vector<double> bounded(const std::vector<double>& lengths) const {
        std::vector<double> result = lengths;
        for (std::size_t v = 0; v < lower_.size(); ++v) {
            result[v] = std::max(result[v], lower_[v]);
            if (!upper_.empty()) result[v] = std::min(result[v], upper_[v]);
        }
        return result;
    }

    // Without bounds and gradation the area is in proportion to 1 / scale^2.
    [[nodiscard]] double first_scale() const {
        double sum = 0, whole = 0;
        for (Index f = 0; f < surface_.num_faces(); ++f) {
            const double area = face_area(surface_, f);
            whole += area;
            for (const Index v : surface_.mesh.triangles[f]) {
                const double length = wanted(v, 1);
                sum += area / 3 / (length * length);
            }
        }
        return std::sqrt((sum > 0 ? sum : whole) / area_);
    }

    [[nodiscard]] double wanted(Index v, double scale) const {
        if (sizing_.max_error > 0) {
            return length_for_error(std::numbers::sqrt2 * values_[v], sizing_.max_error);
        }
        if (sizing_.is_adaptive) return scale / std::cbrt(values_[v]);
        if (!sizing_.densities.empty()) return scale / std::sqrt(values_[v]);
        return scale * values_[v];
    }

    [[nodiscard]] TargetLengths at(double scale) {
        TargetLengths result;
        result.length.reserve(values_.size());
        for (Index v = 0; v < values_.size(); ++v) {
            const double longest = most_.empty() ? longest_ : std::min(longest_, most_[v]);
            result.length.push_back(
                std::max(std::min(wanted(v, scale), longest), sizing_.min_edge));
        }
        limit_growth(surface_, joined_, slope_, Paths::Edges, result.length, ticker_);
        return result;
    }

    // The search measures along edges only, which is quicker and changes the area little.
    [[nodiscard]] TargetLengths finished(TargetLengths targets) const {
        limit_growth(surface_, joined_, slope_, Paths::Lines, targets.length, ticker_);
        targets.length = bounded(targets.length);
        return targets;
    }

    // The logarithm of the area over that wanted.
    [[nodiscard]] double error_of(const TargetLengths& lengths) const {
        return std::log(area_in_lengths(surface_, bounded(lengths.length)) / area_);
    }

    const Surface& surface_;
    std::span<const double> values_, most_;
    std::span<const std::pair<Index, Index>> joined_;
    const Sizing& sizing_;
    double area_;
    Ticker& ticker_;
    double slope_;
    double mean_ = 0, longest_ = 0;
    std::vector<double> lower_, upper_;  // #V; empty: there are no such bounds.
};

}  // namespace

double length_for_error(double curvature, double error) {
    if (!(curvature > 0)) return std::numeric_limits<double>::infinity();
    const double radius = std::max(1 / curvature, error);
    return std::sqrt(3 * error * (2 * radius - error));
}

TargetLengths target_lengths(const Surface& surface, std::span<const double> values,
                             std::span<const double> most,
                             std::span<const std::pair<Index, Index>> joined, const Sizing& sizing,
                             double area, Ticker& ticker, std::span<const double> least) {
    return LengthSearch(surface, values, most, joined, sizing, area, least, ticker).run();
}

}  // namespace remesh
