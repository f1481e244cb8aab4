//! \file
//! Which conics an arc consists of, and points on them.
#pragma once

#include "agvd/diagram/bisectors.h"

namespace agvd {

//! How densely arcs are drawn.
struct ArcDrawing {
    double chord_tolerance;  //!< As in DiagramOptions.
    double tolerance;        //!< Likewise.
};

//! Replaces the inner points of an arc by points of its conics, to both tolerances, and appends its
//! shapes. A conic ends where another relay of one of the sites becomes the nearest: at a ray by a
//! vertex, or at a ridge. One shape, a chord, where the bisector is not to be found.
//! \param size      of the triangle: its longest side.
//! \param relays    of the arc's left site, and of its right one.
//! \param ends      where its tail and its head lie.
//! \param arc       of `out`; all its shapes so far are of arcs before this one.
//! Cost: O(relays) quick steps, and some 40 times as many where a conic ends.
void shape_arc(double size, const std::array<Relays, 2>& relays, const Chord& ends,
               const ArcDrawing& drawing, Index arc, Arcs& out);

}  // namespace agvd
