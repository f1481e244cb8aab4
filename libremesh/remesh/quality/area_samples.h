//! \file
//! Points spread evenly over the area of a mesh.
#pragma once

#include <vector>

#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Point i of n is random in the i-th of n strata of equal area. The mesh must outlive this.
class AreaSamples {
public:
    //! \param mesh  at least one face has an area; faces without get no point. Cost: O(#F).
    explicit AreaSamples(const MeshView& mesh);

    //! \param i  below n; the same point in each call. Cost: O(log #F).
    [[nodiscard]] SurfacePoint at(Index i, Index n) const;

private:
    std::vector<double> area_up_to_;  // #F: of a face and all before it.
};

}  // namespace remesh::detail
