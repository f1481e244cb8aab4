//! \file
//! The arcs of one level in one face, and how they follow one another there. Private to isolines.
#pragma once

#include <span>
#include <vector>

#include "agvd/diagram/face_relays.h"

namespace agvd {

//! An end of an arc.
struct FaceArcEnd {
    Vec2 at;
    Index side = no_index;  //!< 0 to 2: on that side of the face; no_index: inside.
};

//! Counter-clockwise about the centre, less than half of the circle; or straight.
struct FaceArc {
    Vec2 centre;    //!< As IsolineArc::centre.
    double radius;  //!< As IsolineArc::radius.
    Index site;
    FaceArcEnd begin, end;
    Index next = no_index;  //!< The arc that follows in the face.
};

//! Appends the boundary of {p in the face: some relay reaches p within `level`}.
//!
//! The circles of all relays, and the lines of those with parallel paths, are cut where they meet
//! the sides of the face, each other and the ends of what an image sees; pieces remain that no
//! relay reaches by less.
//! \param corners  of the face, counter-clockwise.
//! \param relays   in the same frame. Of those that reach a point equally the first counts.
//! \param with_bends  whether paths that bend at the end of an interval count: they win nowhere if
//!                    the distances are exact.
//! Cost: O(k^2 log k + pieces k), k = relays that reach the face within the level.
void append_face_arcs(const std::array<Vec2, 3>& corners, std::span<const PlanarRelay> relays,
                      double level, bool with_bends, std::vector<FaceArc>& arcs);

}  // namespace agvd
