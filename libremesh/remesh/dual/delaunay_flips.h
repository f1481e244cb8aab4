//! \file
//! Flips edges towards the Delaunay condition. Private to the dual.
#pragma once

#include <functional>
#include <span>

#include "remesh/dual/flippable_mesh.h"

namespace remesh {

//! `measure` gives the length of the edge between the two corners opposite an edge, before a flip
//! is decided; `accept` is called after the flip.
struct Diagonals {
    std::function<double(Index edge)> measure;
    std::function<void(Index edge)> accept;
};

struct FlipCounts {
    Index failing_before = 0;  //!< Inner edges whose opposite angles sum to more than pi (by
    Index failing_after = 0;   //!< more than 1e-6 radians).
    Index flips = 0;
    bool is_finished = true;  //!< False: stopped after 10 flips for each edge.
};

//! Flips edges that fail the Delaunay condition if the following holds. The mesh stays a simplicial
//! complex with the same boundary. The new edge meets the condition, and the sides keep the
//! triangle inequality. In space no edge around becomes sharper than 60 degrees, or than the
//! sharpest one there before.
//!
//! \param length     by edge; updated by flips.
//! \param positions  by vertex.
FlipCounts flip_to_delaunay(FlippableMesh& mesh, std::vector<double>& length,
                            std::span<const Vec3> positions, const Diagonals& diagonals,
                            Ticker ticker = {});

}  // namespace remesh
