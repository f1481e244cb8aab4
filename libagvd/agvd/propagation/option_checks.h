//! \file
//! Checks of the options of propagation.
#pragma once

#include "agvd/mesh/surface.h"
#include "agvd/propagation/propagation_options.h"

namespace agvd {

//! \throw InvalidOption naming the option, its value and the remedy.
void check_options(const Surface& surface, const PropagationOptions& options);

}  // namespace agvd
