//! \file
//! Why a site is added.
#pragma once

#include <cstdint>

#include "remesh/names.h"

namespace remesh {

//! What is wrong with a cell or with the mesh, and is repaired by one more site.
enum class SiteReason : std::uint8_t {
    BoundaryCorner,      //!< A corner of the boundary has no site.
    WholeComponent,      //!< The cell covers a whole component.
    NoDisc,              //!< The cell is not a disc.
    ClosedCurve,         //!< It meets another cell along a closed curve.
    SeveralArcs,         //!< It meets another cell in more than one arc.
    BoundaryAtBothEnds,  //!< Its arc with another cell cuts the surface apart.
    BoundaryTwice,       //!< It meets the boundary in more than one arc.
    SameThirdCell,       //!< Two Voronoi vertices have the same three cells.
    NoSite,              //!< A component has no site.
    SelfIntersection,    //!< The mesh self-intersects there.
};

//! A fixed text: the key in JSON reports.
[[nodiscard]] const char* to_text(SiteReason reason);

//! Where the site is, for texts: "in cells that are not discs".
[[nodiscard]] const char* place_text(SiteReason reason);

}  // namespace remesh
