//! \file
//! Distances of a few points from the nearest of many segments, up to a limit.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/point_grid.h"
#include "agvd/mesh/scale.h"

namespace remesh::detail {

//! Keeps the points in a grid; segments are passed one after the other and not stored.
class PointDistances {
public:
    //! \param reach  mesh units, > 0: larger distances are not searched for.
    //! Cost: O(n).
    PointDistances(std::vector<Vec3> points, double reach)
        : points_(std::move(points)),
          distances_(points_.size(), infinity),
          reach_(reach),
          box_(box_around(points_, reach)),
          grid_(box_.low, cell_size * reach, points_.size()) {
        for (Index i = 0; i < points_.size(); ++i) grid_.add(points_[i], i);
    }

    //! Takes a segment, or a point if both ends are equal. Only the part inside the box of the
    //! points costs time. Cost: O(1 + length / reach).
    void pass(const Vec3& a, const Vec3& b, Ticker& ticker) {
        const auto [from, to] = clip(a, b);
        if (!(from <= to)) return;
        const double length = (to - from) * (b - a).norm();
        const auto steps = static_cast<Index>(std::ceil(length / (spot_distance * reach_)));
        for (Index k = 0; k <= steps; ++k) {
            ticker.tick(8);
            const double t = steps == 0 ? from : from + (to - from) * k / steps;
            grid_.visit_near(a + t * (b - a), spot_reach * reach_, [&](Index i) {
                const double distance = distance_to_segment(points_[i], a, b);
                if (distance <= reach_) distances_[i] = std::min(distances_[i], distance);
            });
        }
    }

    //! #points: from the nearest segment that has passed; infinity beyond `reach`.
    [[nodiscard]] const std::vector<double>& distances() const { return distances_; }

private:
    // In reaches: distance between the spots of a segment around which points are searched, how
    // far, and the side of a cell. A point within reach is half that distance farther from a spot.
    static constexpr double spot_distance = 0.5, spot_reach = 1.3, cell_size = 2.7;

    static MeshBox box_around(const std::vector<Vec3>& points, double reach) {
        MeshBox box;
        for (const Vec3& p : points) {
            box.add(p - Vec3::Constant(reach));
            box.add(p + Vec3::Constant(reach));
        }
        return box;
    }

    // The part of a segment inside the box, as parameters; from > to if there is none.
    [[nodiscard]] std::pair<double, double> clip(const Vec3& a, const Vec3& b) const {
        double from = 0, to = 1;
        for (int k = 0; k < 3; ++k) {
            const double step = b[k] - a[k];
            if (step != 0) {
                const double x = (box_.low[k] - a[k]) / step, y = (box_.high[k] - a[k]) / step;
                from = std::max(from, std::min(x, y));
                to = std::min(to, std::max(x, y));
            } else if (a[k] < box_.low[k] || a[k] > box_.high[k]) {
                to = -1;
            }
        }
        return {from, to};
    }

    std::vector<Vec3> points_;
    std::vector<double> distances_;
    double reach_;
    MeshBox box_;  // Of the points, enlarged by reach.
    PointGrid grid_;
};

}  // namespace remesh::detail
