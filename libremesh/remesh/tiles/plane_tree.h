//! \file
//! Cells of space between planes, each with about the same share of a surface. Private to
//! remeshing.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh {

//! A binary tree: each node divides its part of space by a plane; the leaves are the cells.
struct PlaneTree {
    //! What lies on one side of a plane.
    struct Side {
        Index index = 0;      //!< Of a cell or a node.
        bool is_cell = true;  //!< Otherwise a node.
    };
    struct Node {
        Vec3 normal;        //!< Unit.
        double offset = 0;  //!< normal.dot(p) of the points on the plane.
        Side below, above;  //!< Where normal.dot(p) is less, and more.
    };

    //! The root, then the nodes below it, then those above; these in the same order. Empty: there
    //! is one cell.
    std::vector<Node> nodes;
    Index num_cells = 1;

    [[nodiscard]] Side root() const { return {0, nodes.empty()}; }
};

//! Divides the points by planes through their weighted medians until no cell has more than
//! most_weight, or one point is left. The planes run in three directions that are not those of the
//! axes, as the faces of many meshes lie across these.
//! \param weights      one for each point, >= 0.
//! \param most_weight  > 0.
//! Cost: O(n log n log #cells).
[[nodiscard]] PlaneTree divide_by_planes(std::span<const Vec3> points,
                                         std::span<const double> weights, double most_weight,
                                         Ticker ticker);

}  // namespace remesh
