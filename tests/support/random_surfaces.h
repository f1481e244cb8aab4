//! \file
//! Surfaces whose topology is hard to keep, with random measures.
#pragma once

#include <span>

#include "agvd/mesh/mesh.h"

namespace random_surfaces {

//! Their names: identifiers.
[[nodiscard]] std::span<const char* const> families();

//! An oriented manifold of genus 0 to 20, with 0 to 6 boundary loops and 1 to 10 components, some
//! 20 to 20 000 faces.
[[nodiscard]] agvd::TriangleMesh make(std::string_view family, std::uint64_t seed);

//! A torus knot's tube: p times around the axis, q times through the hole.
[[nodiscard]] agvd::TriangleMesh torus_knot(agvd::Index p, agvd::Index q, agvd::Index steps,
                                            agvd::Index sides, double radius);

//! The frame of an n x m x k grid of rods of square section, one thick and one apart: genus
//! E - V + 1 of the grid's graph.
[[nodiscard]] agvd::TriangleMesh lattice(agvd::Index n, agvd::Index m, agvd::Index k);

//! A plate of n x m squares with square holes in the listed cells, `thickness` thick.
[[nodiscard]] agvd::TriangleMesh plate(
    agvd::Index n, agvd::Index m, const std::vector<std::pair<agvd::Index, agvd::Index>>& holes,
    double thickness);

}  // namespace random_surfaces
