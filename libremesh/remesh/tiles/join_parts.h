//! \file
//! Small parts of a surface join their neighbours. Private to remeshing.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh {

//! A piece of the border between two parts.
struct PartBorder {
    Index a, b;
    double length;  //!< Mesh units.
};

//! Each part below an area joins the larger part with which it has the longest border, as long as
//! there is one. Of parts of one area the first counts as the larger one.
//! \param area     #parts.
//! \param borders  between different parts, in any order, but the sums of lengths follow it.
//! \return #parts: the part that each belongs to, itself or a larger one.
//! Cost: O(#borders log #borders) for each round; a chain of n small parts takes log n rounds at
//! least.
[[nodiscard]] std::vector<Index> join_parts(std::vector<double> area,
                                            std::span<const PartBorder> borders, double least_area);

}  // namespace remesh
