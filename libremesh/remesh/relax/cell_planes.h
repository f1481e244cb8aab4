//! \file
//! How far a point lies from the planes of the surface in a cell: where the cell is flat, moves along
//! it cost nothing; where it is creased, the crease is nearest to all of them.
#pragma once

#include <Eigen/LU>
#include <span>
#include <vector>

#include "agvd/mesh/surface.h"

namespace remesh::detail {

//! A quadric ([garland1997]) without its constant: x^T `spread` x - 2 x^T `lift` is, but for a
//! constant, the integral over the cell of the squared distance of x from the planes.
struct CellPlanes {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  //!< Integral of n n^T, square mesh units.
    agvd::Vec3 lift = agvd::Vec3::Zero();              //!< Integral of n n^T p, p on the surface.

    //! \param vector  the normal of a piece, as long as its area.
    void add(const agvd::Vec3& vector, double area, const agvd::Vec3& point) {
        const agvd::Vec3 scaled = vector / area;
        spread += scaled * vector.transpose();
        lift += scaled.dot(point) * vector;
    }
    //! Half the slope of the integral.
    [[nodiscard]] agvd::Vec3 half_slope(const agvd::Vec3& x) const { return spread * x - lift; }
    //! By how much the integral grows from x to x + step.
    [[nodiscard]] double growth(const agvd::Vec3& x, const agvd::Vec3& step) const {
        return step.dot(spread * step + 2 * half_slope(x));
    }
};

}  // namespace remesh::detail
