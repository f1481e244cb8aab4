//! \file
//! Points of a surface that are nearest to points of a mesh of its cells.
#pragma once

#include <span>
#include <vector>

#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface.h"

namespace remesh::detail {

//! Looks at the faces around the nearest vertex in a few cells only: quick, and never on the far
//! side of a wall.
class NearestInCells {
public:
    //! \param surface         stays as long as this.
    //! \param nearest_vertex  per vertex of the surface: in whose cell it lies; agvd::no_index:
    //! none.
    NearestInCells(const agvd::Surface& surface, std::span<const agvd::Index> nearest_vertex,
                   agvd::Index num_cells);

    //! The distance is infinite if there is no vertex in these cells.
    //! Cost: O(vertices in the cells).
    [[nodiscard]] agvd::ClosestPoint query(const agvd::Vec3& point,
                                           std::span<const agvd::Index> cells) const;

    //! Vertices in these cells.
    [[nodiscard]] std::size_t num_in(std::span<const agvd::Index> cells) const {
        std::size_t count = 0;
        for (const agvd::Index cell : cells) count += begin_[cell + 1] - begin_[cell];
        return count;
    }

private:
    const agvd::Surface& surface_;
    std::vector<agvd::Index> begin_;     // #cells + 1
    std::vector<agvd::Index> vertices_;  // By cell.
    std::vector<agvd::Vec3> at_;         // Likewise: their positions.
};

}  // namespace remesh::detail
