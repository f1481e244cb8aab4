//! \file
//! Nearest points of a surface to points of the dual of its cells.
#pragma once

#include <span>
#include <vector>

#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/mesh/closest_point.h"

namespace remesh::detail {

//! Searches the faces around the nearest vertex in a few cells only, then walks from face to face
//! while the distance falls, no farther than the base's edges there are long. This is quick and
//! never leads to the far side of a wall.
class NearestInCells {
public:
    //! \param base            outlives this.
    //! \param nearest_vertex  per vertex of the base: in whose cell it lies; agvd::no_index: none.
    NearestInCells(const agvd::IntrinsicTriangulation& base,
                   std::span<const agvd::Index> nearest_vertex, agvd::Index num_cells);

    //! A point of the input. The distance is infinite if there is no vertex in these cells.
    //! Cost: O(vertices in the cells).
    [[nodiscard]] agvd::ClosestPoint query(const agvd::Vec3& point,
                                           std::span<const agvd::Index> cells) const;

private:
    [[nodiscard]] agvd::ClosestPoint closest(agvd::Index face, const agvd::Vec3& point) const;
    void descend(const agvd::Vec3& point, agvd::Index vertex, agvd::ClosestPoint& nearest) const;

    const agvd::IntrinsicTriangulation& base_;
    const agvd::Surface& input_;
    std::vector<agvd::Index> begin_;     // #cells + 1
    std::vector<agvd::Index> vertices_;  // By cell.
    std::vector<agvd::Vec3> at_;         // Likewise: their positions.
};

}  // namespace remesh::detail
