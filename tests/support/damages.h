//! \file
//! Kinds of damage to any mesh, as scanners, modellers and converters of files leave them behind.
#pragma once

#include <span>
#include <string_view>

#include "agvd/mesh/mesh.h"
#include "support/dice.h"

namespace damages {

//! Their names: identifiers.
[[nodiscard]] std::span<const char* const> kinds();

//! The mesh damaged in one of these ways, with an amount drawn by the dice. The coordinates stay
//! finite, and at least one face is left.
//! \param mesh  with at least one face; may be damaged already, also to scales of 1e30.
[[nodiscard]] agvd::TriangleMesh apply(std::string_view kind, agvd::TriangleMesh mesh, Dice& dice);

}  // namespace damages
