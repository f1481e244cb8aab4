//! \file
//! Small meshes that are hard for geodesics, each family with random measures.
#pragma once

#include <span>

#include "agvd/mesh/mesh.h"

namespace random_meshes {

//! Their names: identifiers.
[[nodiscard]] std::span<const char* const> families();

//! An oriented manifold (or several) of about 4 to 400 faces that build_surface takes; half of them
//! turned, moved and scaled at random, so that planar or regular parts are so only up to rounding.
[[nodiscard]] agvd::TriangleMesh make(std::string_view family, std::uint64_t seed);

}  // namespace random_meshes
