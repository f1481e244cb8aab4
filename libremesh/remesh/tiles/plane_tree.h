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

//! Divides the points by planes into cells of about equal weights: fewer where points lie at one
//! place. The planes run in three directions that are not those of the axes, as the faces of many
//! meshes lie across these.
//! \param weights    one for each point, >= 0.
//! \param num_cells  >= 1.
//! Cost: O(n log n log num_cells).
[[nodiscard]] PlaneTree divide_by_planes(std::span<const Vec3> points,
                                         std::span<const double> weights, Index num_cells,
                                         Ticker ticker);

}  // namespace remesh
