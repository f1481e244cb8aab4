//! \file
//! What the Steiner engine adds to distances to order its nodes.
#pragma once

#include <algorithm>
#include <cmath>

#include "agvd/mesh/scale.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {

//! A height of points of the surface that rises along no path by as much as the path is long: the
//! coordinate along the longest axis, on the faces linear between the vertices, times a factor.
//!
//! A search may settle its nodes by distance + height in place of the distance: no node is settled
//! before those that its shortest path passes ([hart1968]), so the distances stay the same. But the
//! front goes over the surface from one end to the other. Few nodes wait at a time where there are
//! many sites, whose fronts would otherwise be everywhere at once.
class Sweep {
public:
    //! Cost: O(n).
    explicit Sweep(const Surface& surface) : positions_(surface.mesh.positions) {
        const MeshBox box = box_of(surface.mesh.view());
        if (box.is_empty()) return;
        range_ = (box.high - box.low).maxCoeff(&axis_);
        lowest_ = box.low[axis_];
        if (!(range_ > 0)) return;
        constexpr double share = 0.9;  // Keeps rounding out of comparisons.
        double steepest = 1;
        for (Index f = 0; f < surface.num_faces(); ++f) {
            steepest = std::max(steepest, slope(surface, f));
        }
        factor_ = share / steepest;
    }

    //! Of a vertex, mesh units, >= 0.
    [[nodiscard]] double height(Index vertex) const {
        return factor_ * (positions_[vertex][axis_] - lowest_);
    }
    //! Of a point.
    [[nodiscard]] double height(const Surface& surface, const SurfacePoint& point) const {
        double sum = 0;
        for (Index k = 0; k < 3; ++k) {
            sum += point.barycentric[k] * height(surface.tail(3 * point.face.value() + k));
        }
        return sum;
    }
    //! No height is above it.
    [[nodiscard]] double range() const { return factor_ * range_; }

private:
    // Of the coordinate in a face. It is above 1 only where faces are not those between the
    // positions.
    [[nodiscard]] double slope(const Surface& surface, Index face) const {
        Index h = 3 * face;
        for (Index i = 3 * face + 1; i < 3 * face + 3; ++i) {
            if (surface.length_of(i) > surface.length_of(h)) h = i;
        }
        const auto at = [&](Index v) { return positions_[v][axis_]; };
        const double tail = at(surface.tail(h));
        const double along = (at(surface.head(h)) - tail) / surface.length_of(h);
        const Vec2& apex = surface.apex[h];
        const double across = at(surface.tail(Surface::previous(h))) - tail - along * apex.x();
        // In a face without width the height is constant across it, but for rounding.
        constexpr double rounding = 1e-13;
        const double steep = std::max(std::abs(across) - rounding * range_, 0.0) / apex.y();
        return std::sqrt(along * along + steep * steep);
    }

    const std::vector<Vec3>& positions_;
    Eigen::Index axis_ = 0;
    double lowest_ = 0;
    double range_ = 0;
    double factor_ = 0;
};

}  // namespace agvd
