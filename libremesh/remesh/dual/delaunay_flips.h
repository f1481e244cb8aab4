//! \file
//! Flips edges until the Delaunay condition holds. Private to the dual.
#pragma once

#include <functional>
#include <span>

#include "remesh/dual/flippable_mesh.h"

namespace remesh {

//! How long the edge between the two corners opposite an edge would be; asked once before each
//! flip, and `accept` after it was done.
struct Diagonals {
    std::function<double(agvd::Index edge)> measure;
    std::function<void(agvd::Index edge)> accept;
};

struct FlipCounts {
    agvd::Index failing_before = 0;  //!< Inner edges whose opposite angles sum to more than pi (by
    agvd::Index failing_after = 0;   //!< more than 1e-6 radians).
    agvd::Index flips = 0;
    bool is_finished = true;  //!< False: stopped after 10 flips for each edge.
};

//! Flips what fails the Delaunay condition and can be flipped: the mesh stays a simplicial complex
//! of the same boundary; the new edge meets the condition and the sides keep the triangle
//! inequality; and in space no edge around gets sharper than 60 degrees (or than the sharpest one
//! there had been).
//!
//! \param length     by edge; follows the flips.
//! \param positions  by vertex.
FlipCounts flip_to_delaunay(FlippableMesh& mesh, std::vector<double>& length,
                            std::span<const agvd::Vec3> positions, const Diagonals& diagonals,
                            agvd::Ticker ticker = {});

}  // namespace remesh
