//! \file
//! Lines of equal distance from the sites. In a face they are arcs of circles about the images of
//! the sites, and straight in front of edges of lines and regions; those arcs are what is kept:
//! polylines are drawn from them.
//! Held by Isolines in tests/agvd/paths and IsolinesAgainstExact in tests/oracle.
#pragma once

#include <span>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "agvd/propagation/propagate.h"

namespace agvd {

//! A part of a circle in one face, less than half of it, or a straight piece. The nearer side, with
//! the image, is on the left: a circle runs counter-clockwise about its centre.
struct IsolineArc {
    FaceId face;  //!< In which it lies.
    SiteId site;  //!< From which its points have the distance.
    //! The image of the site or pseudo-source, in the frame of half-edge 3 face; of a straight
    //! piece the unit vector towards the site.
    Vec2 centre;
    double radius = 0;  //!< Mesh units; infinity: a straight piece.
    Vec2 begin;         //!< First point, in the same frame.
    Vec2 end;           //!< Last point.
};

//! A chain of arcs. An open one begins and ends on the surface's boundary.
struct Isoline {
    Index level = 0;         //!< Of the levels that were asked for.
    bool is_closed = false;  //!< Its last arc ends where the first one begins.
};

//! Line l has the arcs [line_arcs[l], line_arcs[l + 1]). Lines come by level, open ones first, then
//! by their first face.
struct Isolines {
    std::vector<Isoline> lines;       //!< Level and kind of each.
    std::vector<Index> line_arcs{0};  //!< #lines + 1 offsets into arcs.
    std::vector<IsolineArc> arcs;     //!< Each begins where the one before ends.
};

//! `{}` gives the defaults.
struct IsolineOptions {
    int num_threads = 0;     //!< >= 0; 0: all cores. The same bytes for any number.
    Progress progress = {};  //!< Polled during the call; see agvd::poll.
};

//! The lines at which the distance from the nearest site is one of the levels.
//!
//! With an exact propagation the points of the arcs are at their level up to 1e-9 of it: rounding,
//! and a level that meets the distance of a vertex is raised by 2e-10 of it, so that no line passes
//! through a vertex. With errors, arcs may leave gaps, or small loops beside a line, of about those
//! errors.
//! \param propagation  propagate(surface, sites) with relays in all faces that levels may cross:
//!                     PropagationOptions::relay_faces = faces_at_levels(), or all_faces(surface).
//! \param levels       mesh units, finite and above 0, in any order.
//! \throw InvalidOption  a level is not finite and above 0.
//! \throw InvalidInput   a face that a level may cross has no relays; the text names it.
//! \throw Cancelled      the progress callback returned false.
//! Parallel. Cost: O(#F + k^2 log k) for the k relays that are about as near as a level in a face,
//! for each face and level that meet.
[[nodiscard]] Isolines build_isolines(const Surface& surface, const Propagation& propagation,
                                      std::span<const double> levels,
                                      const IsolineOptions& options = {});

//! The faces that levels may cross, ascending. Two propagations, one for the distances that this
//! reads and one with relays in these faces only, cost far less than one with all relays.
//! \throw InvalidOption  as build_isolines.  Cost: O(#F log #levels).
[[nodiscard]] std::vector<Index> faces_at_levels(const Surface& surface,
                                                 const Propagation& propagation,
                                                 std::span<const double> levels);

//! step, 2 step, ... up to the largest distance of a vertex.
//! \throw InvalidOption  the step is not finite and above 0, or gives more than 10^6 levels.
[[nodiscard]] std::vector<double> levels_every(const Propagation& propagation, double step);

//! Polylines on the surface.
struct DrawnIsolines {
    std::vector<SurfacePoint> points;  //!< Each in the face of an arc that it lies on.
    std::vector<Index> offsets{0};     //!< #lines + 1 offsets into points; a closed line ends with
                                       //!< its first point.
};

//! The arcs as polylines whose points lie on the arcs.
//! \param tolerance  largest distance of a polyline from its arcs, mesh units, above 0.
//! \throw InvalidOption  the tolerance is not above 0.
//! Cost: O(arcs + points).
[[nodiscard]] DrawnIsolines draw_isolines(const Surface& surface, const Isolines& isolines,
                                          double tolerance);

}  // namespace agvd
