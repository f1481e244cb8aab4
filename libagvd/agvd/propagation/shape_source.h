//! \file
//! Where the shortest paths from a line or a region begin.
#pragma once

#include <vector>

#include "agvd/propagation/propagate.h"

namespace agvd {

//! A shape as a source of paths. No path crosses it: from there on its own are shorter.
struct ShapeSource {
    //! Ascending: the half-edges of its edges, and of its region's border, whose faces lie outside
    //! of its region.
    std::vector<Index> sides;
    //! Ascending: all vertices at distance 0.
    std::vector<Index> vertices;
};

//! Cost: O(n log n) of the shape's edges and faces.
[[nodiscard]] ShapeSource shape_source(const Surface& surface, const SiteShape& shape);

//! \throw InvalidSites  a shape is empty, or names an edge or a face that does not exist.
void check_shapes(const Surface& surface, const std::vector<SiteShape>& shapes);

//! The points that lie on none of the shapes, by index.
[[nodiscard]] std::vector<Index> points_off_shapes(const Surface& surface,
                                                   std::span<const SurfacePoint> points,
                                                   const std::vector<SiteShape>& shapes);

}  // namespace agvd
