//! \file
//! Patches of a mesh that is cut along curves become one again.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/types.h"

namespace remesh {

struct GluedMesh {
    std::vector<agvd::Triangle> triangles;    //!< In the order given; of the glued vertices.
    std::vector<agvd::Index> vertex;          //!< Of each vertex given: the glued one.
    std::vector<agvd::Index> representative;  //!< Of each glued vertex: the first one given.
};

//! Makes one vertex of all those of a group. An edge that two patches have besides each other's
//! curves would be one of four triangles: it is flipped in one of them, if a flip is to be had.
//!
//! \param group  #V: equal for the copies of a vertex.
//! Cost: O(n log n).
[[nodiscard]] GluedMesh glue(std::span<const agvd::Triangle> triangles,
                             std::span<const agvd::Index> group);

}  // namespace remesh
