//! \file
//! The squared distance of a point from the planes of the faces in a cell. In a planar cell, moves
//! in the plane cost nothing; in a creased cell, the crease is nearest to all planes.
#pragma once

#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh::detail {

//! A quadric ([garland1997]): x^T `spread` x - 2 x^T `lift` + `constant` is the integral over the
//! cell of the squared distance of x from the planes.
struct CellPlanes {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  //!< Integral of n n^T, square mesh units.
    Vec3 lift = Vec3::Zero();                          //!< Integral of n n^T p, p on the surface.
    double constant = 0;                               //!< Integral of (n^T p)^2.

    //! \param vector  the normal of a piece, as long as its area.
    void add(const Vec3& vector, double area, const Vec3& point) {
        const Vec3 normal = (1 / area) * vector;
        const double height = normal.dot(point);
        spread += normal * vector.transpose();
        lift += height * vector;
        constant += height * height * area;
    }
    //! The integral: of fourth order in lengths; rounding may make it negative.
    [[nodiscard]] double at(const Vec3& x) const {
        return x.dot(spread * x) - 2 * x.dot(lift) + constant;
    }
    //! Half the gradient of the integral.
    [[nodiscard]] Vec3 half_slope(const Vec3& x) const { return spread * x - lift; }
    //! The growth of the integral from x to x + step.
    [[nodiscard]] double growth(const Vec3& x, const Vec3& step) const {
        return step.dot(spread * step + 2 * half_slope(x));
    }
};

}  // namespace remesh::detail
