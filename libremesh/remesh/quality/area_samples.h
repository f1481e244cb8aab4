//! \file
//! Points spread evenly over the area of a mesh.
#pragma once

#include <algorithm>
#include <vector>

#include "agvd/core/random.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Point i of n is random in the i-th of n strata of equal area. The mesh must outlive this.
class AreaSamples {
public:
    //! \param mesh  at least one face has an area; faces without get no point. Cost: O(#F).
    explicit AreaSamples(const MeshView& mesh) {
        area_up_to_.reserve(mesh.triangles.size());
        double area = 0;
        for (const Triangle& t : mesh.triangles) {
            area += doubled_normal(mesh.positions, t).norm() / 2;
            area_up_to_.push_back(area);
        }
    }

    //! \param i  below n; the same point in each call. Cost: O(log #F).
    [[nodiscard]] SurfacePoint at(Index i, Index n) const {
        const double area = (i + random_unit(0, 0, i)) / n * area_up_to_.back();
        const auto face = std::upper_bound(area_up_to_.begin(), area_up_to_.end() - 1, area);
        return {FaceId(static_cast<Index>(face - area_up_to_.begin())),
                uniform_barycentric(random_unit(0, 1, i), random_unit(0, 2, i))};
    }

private:
    std::vector<double> area_up_to_;  // #F: of a face and all before it.
};

}  // namespace remesh::detail
