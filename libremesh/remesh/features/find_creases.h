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
    //! What is too short or too weak for the spacing is left out, and gaps are closed: scans stay
    //! as they are. False: all edges above the angle, but for false angles at needles.
    bool is_automatic = true;
    int num_threads = 0;  //!< >= 0; 0: all cores. Any number gives the same result.
    agvd::Progress progress = {};
};

//! Finds the edges of creases.
//!
//! Edges above the angle make chains. Gaps of about a spacing inside a chain are closed along
//! weaker edges. Chains that end in nothing and are short and weak go, shortest first, and so do
//! networks most of whose length is in chains shorter than the spacing: both are what noise looks
//! like on scans. What counts are lengths, never numbers of edges, and faces too thin to have a
//! direction take that of their neighbours, so that all triangulations of a surface give the same
//! network.
//!
//! \return #E of the surface: 1 for the edges of creases. Boundary edges are never.
//! \throw agvd::InvalidOption  an option out of range.
//! \throw agvd::Cancelled      the progress callback returned false.
//! Cost: O(#F + k log k), k = edges above the angle and faces that are too thin.
[[nodiscard]] std::vector<std::uint8_t> find_creases(const agvd::Surface& surface,
                                                     const CreaseOptions& options);

}  // namespace remesh
