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
    //! Of each glued vertex: the first one given of its group. Equal where sheets meet in vertices
    //! of their own.
    std::vector<agvd::Index> first_of_group;
};

//! Makes one vertex of those of a group. An edge that two patches have besides each other's
//! curves would be one of four triangles: it is flipped in one of them, if a flip is to be had.
//!
//! \param group   #V: equal for copies at one place: of no two groups is there more than one edge.
//! \param vertex  #V: equal for those of a group that become one; the default is all of them.
//! Cost: O(n log n).
[[nodiscard]] GluedMesh glue(std::span<const agvd::Triangle> triangles,
                             std::span<const agvd::Index> group,
                             std::span<const agvd::Index> vertex = {});

}  // namespace remesh
