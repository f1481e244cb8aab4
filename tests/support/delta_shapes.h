//! \file
//! Surfaces whose intrinsic Delaunay triangulations are Delta-complexes, and meshes of needles.
#pragma once

#include <span>
#include <string_view>

#include "agvd/mesh/mesh.h"

namespace delta_shapes {

//! Their names: identifiers.
[[nodiscard]] std::span<const char* const> families();

//! An oriented manifold of 2 to some 300 faces that build_surface takes, random in its measures.
[[nodiscard]] agvd::TriangleMesh make(std::string_view family, std::uint64_t seed);

}  // namespace delta_shapes
