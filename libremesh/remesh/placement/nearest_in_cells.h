//! \file
//! Nearest points of a surface to points of the dual of its cells.
#pragma once

#include <span>
#include <vector>

#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/mesh/closest_point.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Searches the faces around the nearest vertex in a few cells only, then walks from face to face
//! while the distance falls, no farther than the base's edges there are long. This is quick and
//! never leads to the far side of a wall.
class NearestInCells {
public:
    //! \param base            outlives this.
    //! \param nearest_vertex  per vertex of the base: in whose cell it lies; no_index: none.
    NearestInCells(const IntrinsicTriangulation& base, std::span<const Index> nearest_vertex,
                   Index num_cells);

    //! A point of the input. The distance is infinite if there is no vertex in these cells.
    //! Cost: O(vertices in the cells).
    [[nodiscard]] ClosestPoint query(const Vec3& point, std::span<const Index> cells) const;

private:
    [[nodiscard]] ClosestPoint closest(Index face, const Vec3& point) const;
    void descend(const Vec3& point, Index vertex, ClosestPoint& nearest) const;

    const IntrinsicTriangulation& base_;
    const Surface& input_;
    std::vector<Index> begin_;     // #cells + 1
    std::vector<Index> vertices_;  // By cell.
    std::vector<Vec3> at_;         // Likewise: their positions.
};

}  // namespace remesh::detail
