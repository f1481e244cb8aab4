//! \file
//! The sharp creases of a surface at the scale of the sites: those of a part are found, the noise
//! of a scan is not, whatever its triangles. And what becomes of junctions. Held by FindCreases.*
//! in tests/remesh/curves.
#pragma once

#include <cstdint>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh {

//! What the result does with edges that have more than two faces in the input.
enum class Junctions {
    Apart,  //!< Each sheet has vertices of its own there, at the same points.
    Keep    //!< The sheets are welded again: the result is non-manifold there, like the input.
};

//! Lower-case name of a choice: "apart" or "keep".
[[nodiscard]] const char* junctions_name(Junctions junctions);

//! `{}` gives the defaults.
struct CreaseOptions {
    double angle = 40;   //!< Degrees, in (0, 180): least dihedral angle of a crease.
    double spacing = 0;  //!< Mesh units, > 0: mean distance of neighbouring sites.
    //! Leaves out noise and what is too short or too weak for the spacing, and closes gaps. False:
    //! all edges above the angle, except for false angles at needles.
    bool is_automatic = true;
    int num_threads = 0;     //!< >= 0; 0: all cores. Any number gives the same result.
    Progress progress = {};  //!< Polled during the call; see poll.
};

//! Finds the edges of creases.
//!
//! 1. Edges above the angle are candidates. A face too narrow takes its neighbours' normal.
//! 2. An edge weighs more the sharper it is, and less if the surface around it turns as sharply.
//! The
//!    share of such edges tells parts from scans.
//! 3. Gaps of up to a spacing are closed along edges of at least 5/8 of the angle.
//! 4. Chains with open ends whose length times weight is below a spacing (three, if both are open)
//!    are removed, then networks of too little weight: much more is needed on scans.
//! 5. The open ends that are left continue along edges of at least 5/8 of the angle.
//!
//! All criteria are lengths, so all triangulations of a surface give the same creases.
//! \return #E: 1 for the edges of creases; 0 for boundary edges.
//! \throw InvalidOption  an option out of range.
//! \throw Cancelled      the progress callback returned false.
//! Cost: O(#F + k log k), k = edges above the angle and faces that are too narrow.
[[nodiscard]] std::vector<std::uint8_t> find_creases(const Surface& surface,
                                                     const CreaseOptions& options);

}  // namespace remesh
