//! \file
//! Joins the patches of a mesh that was cut along curves.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh {

struct GluedMesh {
    std::vector<Triangle> triangles;    //!< In the given order; corners are glued vertices.
    std::vector<Index> vertex;          //!< Of each given vertex: the glued one.
    std::vector<Index> representative;  //!< Of each glued vertex: the first given one.
    //! Of each glued vertex: the first given vertex of its group. Equal for vertices of different
    //! sheets at one place.
    std::vector<Index> first_of_group;
};

//! Makes the vertices of a group one. If an inner edge of a patch joins the same groups as an edge
//! of another patch, the glued edge would have more than two faces; such an inner edge is flipped
//! if possible.
//!
//! \param group   #V: equal for copies at one place. Two groups are to have at most one edge.
//! \param vertex  #V: equal for the copies of a group that become one vertex; empty: all of them.
//! Cost: O(n log n).
[[nodiscard]] GluedMesh glue(std::span<const Triangle> triangles, std::span<const Index> group,
                             std::span<const Index> vertex = {});

}  // namespace remesh
