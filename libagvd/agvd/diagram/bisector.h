//! \file
//! Points on the bisector of two sites inside a triangle.
#pragma once

#include <optional>

#include "agvd/diagram/local_diagram.h"
#include "agvd/diagram/triangle_sites.h"

namespace agvd {

struct Chord {
    Vec2 from, to;
};

struct BisectorPoint {
    Vec2 position;
    double distance;  //!< From both sites.
};

//! The point of the bisector of two sites opposite the middle of a chord.
//! \return none if there is none near, or it lies outside.
[[nodiscard]] std::optional<BisectorPoint> project(const TriangleSites& triangle, Relays a,
                                                   Relays b, const Chord& chord);

//! Appends inner points of the bisector between the ends of a chord to `out.points`, such that it
//! strays from the polyline by less than a share of each piece.
void sample_bisector(const TriangleSites& triangle, const std::array<Index, 2>& sites,
                     const Chord& chord, double tolerance, LocalDiagram& out);

//! By how much a third site is nearer in the middle of the bisector of two sites.
[[nodiscard]] double arc_undercut(const TriangleSites& triangle, const std::array<Index, 2>& sites,
                                  const Chord& chord);

}  // namespace agvd
