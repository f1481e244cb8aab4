//! \file
//! Faces with two label changes and one straight arc between them.
#pragma once

#include "agvd/diagram/face_relays.h"
#include "agvd/diagram/local_diagram.h"

namespace agvd {

//! Whether the bisector of two sites clearly strays from a chord by less than the tolerance (share
//! of the chord), by one Newton step across its middle: by Kantorovich's theorem the root lies
//! within twice that step where the slope changes by less than half of itself on the way.
//! \param a, b  of the two sites at the middle.
[[nodiscard]] bool is_nearly_straight(const Vec2& chord, const Vec2& middle, const Reach& a,
                                      const Reach& b, double tolerance);

struct ChordTest {
    double slack;      //!< Mesh units: distances agree up to this.
    double tolerance;  //!< See is_nearly_straight().
};

//! Whether a face's own relays say so of the chord between two breakpoints, and agree with the
//! breakpoints' distances. False: see TriangleSolver, which draws arcs of any
//! shape.
//! \param relays    of the face.
//! \param corners   of the face, in whose frame the breakpoints are.
[[nodiscard]] bool joins_straight(std::span<const Relay> relays, const std::array<Vec2, 3>& corners,
                                  const Breakpoint& from, const Breakpoint& to,
                                  const ChordTest& test);

}  // namespace agvd
