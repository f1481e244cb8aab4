#include "remesh/sites/boundary_curves.h"

#include <algorithm>
#include <cmath>

#include "remesh/curves/curve_network.h"

namespace remesh {

namespace {

// Places at even distances in the unit from `begin` on, before `end`.
std::vector<double> even_places(const Curve& curve, double begin, double end, double fewest,
                                double spacing, const UnitAt& unit_at) {
    const auto intervals_of = [&](double length) {
        return static_cast<Index>(std::max(fewest, std::round(length / spacing)));
    };
    std::vector<double> places;
    if (!unit_at) {
        const Index intervals = intervals_of(end - begin);
        for (Index k = 0; k < intervals; ++k) {
            places.push_back(begin + (end - begin) * k / intervals);
        }
        return places;
    }
    // Steps of half a spacing at most, and their sums.
    std::vector<double> place{begin}, count{0};
    while (place.back() < end) {
        const double from = place.back();
        const double step = spacing * unit_at(point_on_curve(curve, from)) / 2;
        const double to = end - from < 1.5 * step ? end : from + step;
        count.push_back(count.back() +
                        (to - from) / unit_at(point_on_curve(curve, (from + to) / 2)));
        place.push_back(to);
    }
    const Index intervals = intervals_of(count.back());
    for (Index k = 0, i = 0; k < intervals; ++k) {
        const double wanted = count.back() * k / intervals;
        while (i + 2 < place.size() && count[i + 1] < wanted) ++i;
        const double share = (wanted - count[i]) / (count[i + 1] - count[i]);
        places.push_back(place[i] + share * (place[i + 1] - place[i]));
    }
    return places;
}

}  // namespace

std::vector<Index> find_corners(const Surface& surface, const std::vector<Index>& loop,
                                double spacing) {
    std::vector<Index> corners;
    for (const std::size_t i : corners_of_curve(surface, curve_of_loop(surface, loop), spacing)) {
        corners.push_back(surface.tail(loop[i]));
    }
    return corners;
}

std::vector<SurfacePoint> sample_loop(const Surface& surface, const std::vector<Index>& loop,
                                      const std::vector<Index>& corners, double spacing,
                                      const UnitAt& unit_at) {
    const Curve curve = curve_of_loop(surface, loop);
    std::vector<double> ends;  // Places on the loop where its pieces begin.
    for (std::size_t i = 0; i < loop.size() && ends.size() < corners.size(); ++i) {
        if (surface.tail(loop[i]) == corners[ends.size()]) ends.push_back(curve.up_to[i]);
    }
    if (ends.empty()) ends.push_back(0);
    // Least number of intervals of a piece, so that the loop gets three sites.
    const double fewest = std::ceil(3.0 / static_cast<double>(ends.size()));
    std::vector<SurfacePoint> sites;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const double begin = ends[i];
        const double end = i + 1 < ends.size() ? ends[i + 1] : ends[0] + curve.length();
        for (const double place : even_places(curve, begin, end, fewest, spacing, unit_at)) {
            sites.push_back(point_on_curve(curve, place));
        }
    }
    return sites;
}

}  // namespace remesh
