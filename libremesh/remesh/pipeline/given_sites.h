//! \file
//! The caller's sites on the cleaned surface.
#pragma once

#include <vector>

#include "remesh/pipeline/cleaned_input.h"

namespace remesh::detail {

//! \param surface  the cleaned one, which a later stage may own by now.
//! \throw as to_cleaned.
//! \throw InvalidSites  of 1000 sites or more, more than half lie where an earlier one does:
//!        a mistake that would take as long as so many sites elsewhere.
//! Cost: that of to_cleaned and distinct_points.
[[nodiscard]] std::vector<SurfacePoint> given_sites(const CleanedInput& cleaned,
                                                    const Surface& surface,
                                                    const std::vector<SurfacePoint>& sites);

}  // namespace remesh::detail
