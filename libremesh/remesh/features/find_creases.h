//! \file
//! The sharp creases of a surface at the scale of the sites that are to carry them.
#pragma once

#include <cstdint>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"

namespace remesh {

struct CreaseOptions {
    double angle = 40;   //!< Degrees, in (0, 180): least dihedral angle of a crease.
    double spacing = 0;  //!< Mesh units, > 0: of the sites.
    //! What is too short or too weak for the spacing is left out, noise as well, and gaps are
    //! closed. False: all edges above the angle, but for false angles at needles.
    bool is_automatic = true;
    int num_threads = 0;  //!< >= 0; 0: all cores. Any number gives the same result.
    agvd::Progress progress = {};
};

//! Finds the edges of creases.
//!
//! 1. Edges above the angle are candidates. A face too thin to have a direction takes that of its
//!    neighbours.
//! 2. An edge is worth more the sharper it is, and less where the surface beside it turns as
//!    sharply. How much of the candidates' length is so tells parts from scans.
//! 3. Gaps of up to a spacing are closed along edges of at least 5/8 of the angle.
//! 4. Chains that end in nothing go if their length times worth is below a spacing, or three where
//!    both ends do; then networks that are worth too little: on scans much more is too little.
//! 5. Ends that are left go on along edges of at least 5/8 of the angle.
//!
//! What counts are lengths, never numbers of edges, so that all triangulations of a surface give
//! the same creases.
//!
//! \return #E of the surface: 1 for the edges of creases. Boundary edges are never.
//! \throw agvd::InvalidOption  an option out of range.
//! \throw agvd::Cancelled      the progress callback returned false.
//! Cost: O(#F + k log k), k = edges above the angle and faces that are too thin.
[[nodiscard]] std::vector<std::uint8_t> find_creases(const agvd::Surface& surface,
                                                     const CreaseOptions& options);

}  // namespace remesh
