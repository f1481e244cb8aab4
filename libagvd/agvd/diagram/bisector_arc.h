//! \file
//! The arcs of bisectors as they are: pieces of conics in the plane of a face. Their foci are the
//! images of the sites, or of the pseudo-sources that paths from these bend at.
//! Held by BisectorArcs in tests/agvd/diagram.
#pragma once

#include <array>

#include "agvd/mesh/surface.h"

namespace agvd {

//! The shape of an arc. Sites are points, so there are no parabolas: these are as far from a point
//! as from a line.
enum class ArcKind : std::uint8_t {
    Line,       //!< The weights are equal, or differ by the distance of the foci.
    Hyperbola,  //!< A piece of one branch.
    Chord,      //!< Drawn straight where distances with errors contradict each other: no foci.
};

//! Lower-case name of a kind, for files.
[[nodiscard]] const char* arc_kind_name(ArcKind kind);

//! The points p of a face with |p - focus[0]| + weight[0] = |p - focus[1]| + weight[1], from
//! `begin` to `end`. This sum is the distance of p from both sites. Positions are in the frame of
//! half-edge 3 face, as those of IsolineArc; lengths are mesh units. Of a chord only the ends
//! count.
//!
//! If the distances have errors, the ends of the polyline lie beside the conic by about these.
struct BisectorArc {
    FaceId face;                    //!< In which it lies.
    ArcKind kind = ArcKind::Chord;  //!< Its shape.
    Index first_point = 0;          //!< Of Diagram::points, at `begin`.
    //! Of the site on the left of the edge, and on the right.
    std::array<Vec2, 2> focus{Vec2(0, 0), Vec2(0, 0)};
    std::array<double, 2> weight{};  //!< Distances of the sites from these.
    Vec2 begin{0, 0};                //!< First point.
    Vec2 end{0, 0};                  //!< Last point.

    //! Whether all fields are equal.
    friend bool operator==(const BisectorArc&, const BisectorArc&) = default;
};

//! The point of an arc at a share of its way, in its face's frame: 0 is its begin, 1 its end.
//! Others lie on the ray from a focus through the chord's point at this share.
[[nodiscard]] Vec2 point_on_arc(const BisectorArc& arc, double share);

//! Where the foci lie in the plane of the arc's face in space, which holds the arc as well. Where a
//! surface has lengths in place of positions, the face is drawn with another shape, and so are
//! they.
[[nodiscard]] std::array<Vec3, 2> foci_in_space(const Surface& surface, const BisectorArc& arc);

}  // namespace agvd
