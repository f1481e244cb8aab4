//! \file
//! Points inside a triangle that are equally far from two sites, or from three.
#pragma once

#include "agvd/diagram/arcs.h"
#include "agvd/diagram/face_relays.h"

namespace agvd {

//! Distances at a breakpoint that differ by more (share of the longest side) contradict it.
inline constexpr double largest_disagreement = 1e-2;
//! A point this far outside (share of the longest side) still counts as inside.
inline constexpr double inside_tolerance = 1e-11;

using Relays = std::span<const PlanarRelay>;

//! Every cell inside reaches the boundary: other sites than those on it do not matter.
struct TriangleSites {
    struct Group {
        Index site;
        Relays relays;
    };
    std::array<Vec2, 3> corners;  //!< Counter-clockwise.
    double size = 0;              //!< Longest side.
    std::vector<Group> groups;
};

[[nodiscard]] double longest_side(const std::array<Vec2, 3>& corners);

//! Empty for a site that is not on the boundary.
[[nodiscard]] Relays relays_of_site(const TriangleSites& triangle, Index site);

//! By how much another site than these is nearer to p, which is at `distance` from these.
[[nodiscard]] double undercut(const TriangleSites& triangle, const Vec2& p, double distance,
                              std::span<const Index> sites);

// --- Bisectors of two sites --------------------------------------------------------------------

struct Chord {
    Vec2 from, to;
};

//! Whether the ends of each of two chords lie on different sides of the other.
//! \param slack  mesh units, >= 0: ends that are no farther from the other's line are on no side.
[[nodiscard]] inline bool do_cross(const Chord& a, const Chord& b, double slack = 0) {
    const auto divides = [slack](const Chord& line, const Chord& other) {
        const Vec2 along = line.to - line.from;
        const double least = slack * along.norm();
        const double from = cross(along, other.from - line.from);
        const double to = cross(along, other.to - line.from);
        return (from < -least && to > least) || (from > least && to < -least);
    };
    return divides(a, b) && divides(b, a);
}

struct BisectorPoint {
    Vec2 position;
    double distance;  //!< From both sites.
};

//! The point of the bisector opposite the middle of a chord; none if none is near and inside.
[[nodiscard]] std::optional<BisectorPoint> project(const TriangleSites& triangle, Relays a,
                                                   Relays b, const Chord& chord);

//! Appends inner points of the bisector between the ends of a chord to `out.points`, such that it
//! strays from the polyline by less than a share of each piece.
void sample_bisector(const TriangleSites& triangle, const std::array<Index, 2>& sites,
                     const Chord& chord, double tolerance, Arcs& out);

//! By how much a third site is nearer in the middle of the bisector of two sites; where the
//! bisector has none inside the triangle beside the chord, no_voronoi_vertex times the triangle's
//! size.
[[nodiscard]] double arc_undercut(const TriangleSites& triangle, const std::array<Index, 2>& sites,
                                  const Chord& chord);

//! Whether a face's own relays say that the chord between two breakpoints is its one arc: the
//! bisector clearly strays from it by less than the tolerance, and the relays agree with the
//! breakpoints' distances. False: see TriangleSolver, which draws arcs of any shape.
//! \param relays   of the face.
//! \param corners  of the face, in whose frame the breakpoints are.
//! \param slack, tolerance  of distances, mesh units; a share of the chord.
[[nodiscard]] bool joins_straight(std::span<const Relay> relays, const std::array<Vec2, 3>& corners,
                                  const Breakpoint& from, const Breakpoint& to, double slack,
                                  double tolerance);

// --- Voronoi vertices --------------------------------------------------------------------------

//! Where a Voronoi vertex may be.
struct VertexCandidate {
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

//! Where the sites of three intervals meet, counter-clockwise around the vertex.
//! \param thorough  tries more starts. Most vertices that are not found at once are nowhere; to be
//!                  thorough takes twice the time.
[[nodiscard]] VertexCandidate find_voronoi_vertex(const TriangleSites& triangle,
                                                  const std::array<IntervalStart, 3>& intervals,
                                                  bool thorough);

//! The vertex, moved to where rounding alone is left: find_voronoi_vertex() stops a little before.
//! \param relays  of its three sites.
[[nodiscard]] VertexCandidate settled_vertex(const std::array<Relays, 3>& relays,
                                             const VertexCandidate& vertex);

//! That of some positions at which the distances from three sites differ least; by how much is the
//! violation.
//! \param positions  at least one.
[[nodiscard]] VertexCandidate least_unequal(const TriangleSites& triangle,
                                            std::span<const Vec2> positions,
                                            const std::array<Index, 3>& sites);

}  // namespace agvd
