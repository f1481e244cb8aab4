//! \file
//! Invariants that hold for every valid result.
#pragma once

#include <span>

#include "agvd/diagram/diagram.h"
#include "agvd/propagation/propagate.h"

namespace checks {

//! Every edge has two distinct sides and two ends or none; ends, sites and loops around vertices
//! fit together; areas sum to the surface's (of the components with a site); and the Euler
//! characteristics of cells, edges and vertices sum to the surface's.
//! Cells are connected (or have at most so many parts), and their Euler characteristics are those
//! that their loops give. Polylines run from face to face, and inside a face no two of their
//! segments cross.
void expect_valid_complex(const agvd::Surface& surface, const agvd::Diagram& diagram,
                          int most_parts = 1);

//! All fields are equal; of a propagation all except the work done and the memory used.
void expect_same(const agvd::Surface& a, const agvd::Surface& b);
void expect_same(const agvd::Propagation& a, const agvd::Propagation& b);
void expect_same(const agvd::Diagram& a, const agvd::Diagram& b);

//! One thread and three give the same propagation and the same diagram.
void expect_same_for_threads(const agvd::Surface& surface,
                             std::span<const agvd::SurfacePoint> sites,
                             agvd::PropagationOptions options);

}  // namespace checks
