//! \file
//! Where three cells meet inside a triangle.
#pragma once

#include "agvd/diagram/triangle_sites.h"

namespace agvd {

//! A place for a Voronoi vertex.
struct VertexPlace {
    Vec2 position;
    double distance;
    double violation;  //!< How badly the distances contradict it; 0: not at all.
};

//! The violation (share of the triangle's size) where there is no Voronoi vertex at all.
inline constexpr double no_voronoi_vertex = 2;

//! An end of one of three consecutive intervals of the boundary, which has a site behind it.
struct IntervalStart {
    Vec2 position;
    Index site;
};

//! Where the sites of three intervals meet, counter-clockwise around the place.
//! \param thorough  tries more starts. Most vertices that are not found at once are nowhere; to be
//!                  thorough takes twice the time.
[[nodiscard]] VertexPlace find_voronoi_vertex(const TriangleSites& triangle,
                                              const std::array<IntervalStart, 3>& intervals,
                                              bool thorough);

//! That of some places where the distances from three sites differ least; by how much is the
//! violation.
//! \param places  at least one.
[[nodiscard]] VertexPlace least_unequal(const TriangleSites& triangle, std::span<const Vec2> places,
                                        const std::array<Index, 3>& sites);

}  // namespace agvd
