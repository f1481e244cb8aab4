//! \file
//! Where edges have given lengths, as points of the cleaned surface.
#pragma once

#include <vector>

#include "remesh/curves/select_creases.h"
#include "remesh/pipeline/cleaned_input.h"
#include "remesh/sites/sizing.h"

namespace remesh::detail {

//! Points of places on the cleaned surface: those of lines and regions lie half of the length
//! apart, or closer.
//! \throw InvalidInput  there is no such edge or face; the text names it.
//! \throw as to_cleaned.
//! Cost: that of to_cleaned, and O(#F log n) for n edges.
[[nodiscard]] std::vector<SizedPoint> points_of_places(const CleanedInput& cleaned,
                                                       const std::vector<SizedPlace>& places);

}  // namespace remesh::detail
