//! \file
//! Target edge lengths on a surface.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "remesh/names.h"

namespace remesh {

//! Target edge lengths on the vertices of a base, linear in its faces. Points are given on the
//! base's input, or on a surface with the same faces cut along other edges. Immutable; threads may
//! share it.
class SizeField {
public:
    //! \param length  #V of base.surface(), > 0; mesh units.
    //! Cost: O(n).
    SizeField(std::shared_ptr<const IntrinsicTriangulation> base, std::vector<double> length);

    //! Cost: that of IntrinsicTriangulation::to_intrinsic.
    [[nodiscard]] double at(const SurfacePoint& point) const;

    //! #F of the input: area in squares of the local length. A face of the base counts for one face
    //! of the input in the same patch: only sums over patches are exact.
    [[nodiscard]] std::span<const double> area_of_face() const { return area_; }
    //! The sum of area_of_face().
    [[nodiscard]] double area() const { return sum_; }
    //! #F of the input: the least length at its corners and at vertices of the base inside it.
    [[nodiscard]] std::span<const double> least_in_face() const { return least_; }
    //! The least length of all.
    [[nodiscard]] double least() const { return least_of_all_; }

private:
    std::shared_ptr<const IntrinsicTriangulation> base_;
    std::vector<double> length_;
    std::vector<double> area_, least_;
    double sum_ = 0, least_of_all_ = 0;
};

//! A face of the input in the same patch as a face of the base.
[[nodiscard]] Index face_of_input(const IntrinsicTriangulation& base, Index face);

//! The lengths at many points. Null: empty.
[[nodiscard]] std::vector<double> lengths_at(const SizeField* sizes,
                                             std::span<const SurfacePoint> points);
//! SizeField::at as a function, which the field outlives. Null: empty.
[[nodiscard]] std::function<double(const SurfacePoint&)> length_function(const SizeField* sizes);

//! The area of a surface in squares of local lengths. A mesh that follows these has 2 / sqrt(3)
//! times as many vertices, without what a boundary adds.
//! \param length  #V of the surface. Cost: O(#F).
[[nodiscard]] double area_in_lengths(const Surface& surface, std::span<const double> length);

}  // namespace remesh
