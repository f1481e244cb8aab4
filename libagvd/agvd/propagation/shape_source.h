//! \file
//! Where the shortest paths from points, lines and regions begin, and at which distance.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "agvd/propagation/propagate.h"

namespace agvd {

//! Whether an ascending list holds a value.
[[nodiscard]] inline bool is_among(const std::vector<Index>& ascending, Index value) {
    return std::binary_search(ascending.begin(), ascending.end(), value);
}

//! The distance that a point starts with. \param starts  of the points; empty: 0.
[[nodiscard]] inline double start_of(std::span<const double> starts, Index point) {
    return starts.empty() ? 0 : starts[point];
}

//! A shape as a source of paths. None of these crosses it: from there on others are shorter.
struct ShapeSource {
    //! Ascending: the half-edges of its edges, and of its region's border, whose faces lie outside
    //! of its region.
    std::vector<Index> sides;
    //! Ascending: all vertices on it.
    std::vector<Index> vertices;
    double start = 0;  //!< SiteShape::start.

    // Where its paths begin, all ascending: at all sides and vertices, unless other shapes have
    // them.
    std::vector<Index> own_sides;     //!< Beams.
    std::vector<Index> own_vertices;  //!< Fans.
    //! The own sides, and those of any shape at which a sector around an own vertex begins or ends.
    std::vector<Index> sector_sides;
};

//! Cost: O(n log n) of the shape's edges and faces.
[[nodiscard]] ShapeSource shape_source(const Surface& surface, const SiteShape& shape);

//! The source of each shape.
[[nodiscard]] std::vector<ShapeSource> sources_of(const Surface& surface,
                                                  std::span<const SiteShape> shapes);

//! Shapes may share sides and vertices, and lie in regions. Leaves each side and vertex to the one
//! with the least start, of equal ones to the first: from there on others are no nearer. So no two
//! of them tie on a whole area. \param sources  sources_of(shapes).
void leave_own(const Surface& surface, std::span<const SiteShape> shapes,
               std::vector<ShapeSource>& sources);

//! Ascending: its edges, and those of its faces. Cost: O(n log n).
[[nodiscard]] std::vector<Index> all_edges_of(const Surface& surface, const SiteShape& shape);

//! \throw InvalidSites  a shape is empty, names an edge or a face that does not exist, or starts at
//!                       a distance that is out of range.
void check_shapes(const Surface& surface, const std::vector<SiteShape>& shapes);

//! The points that lie on none of the shapes that start no later, by index.
//! \param starts  of the points; empty: 0.
//! Cost: O(n log n) of the points and of the shapes' edges and faces.
[[nodiscard]] std::vector<Index> points_off_shapes(const Surface& surface,
                                                   std::span<const SurfacePoint> points,
                                                   std::span<const double> starts,
                                                   const std::vector<SiteShape>& shapes);

}  // namespace agvd
