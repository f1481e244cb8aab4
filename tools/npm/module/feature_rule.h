//! \file
//! The rule of creases, as JavaScript's callers give it.
#pragma once

#include "options.h"
#include "remesh/pipeline/remesh.h"

namespace npm {

//! Reads the option `features`: 'auto', 'off', or an angle in degrees.
//! \throw agvd::InvalidOption  it is none of these.
void set_feature_rule(Options& given, remesh::RemeshOptions& options);

}  // namespace npm
