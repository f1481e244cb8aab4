//! \file
//! The picture of --picture, where this build can draw one.
#pragma once

#include <string>

#include "agvd/mesh/mesh.h"

namespace cli {

//! \throw agvd::InvalidOption  this build has no libpng.
void require_pictures();

//! Original and result beside each other, as PNG. \pre require_pictures() does not throw.
[[nodiscard]] std::string picture_of(const agvd::MeshView& original, const agvd::MeshView& result);

}  // namespace cli
