//! \file
//! The functions that JavaScript can call.
#pragma once

#include "message.h"

namespace npm {

//! \throw agvd::Error  as the functions of the libraries that they call, in the terms of the program.

[[nodiscard]] Answer call_remesh(const Request& request);
[[nodiscard]] Answer call_voronoi(const Request& request);
[[nodiscard]] Answer call_distances(const Request& request);
[[nodiscard]] Answer call_creases(const Request& request);
[[nodiscard]] Answer call_read(const Request& request);
[[nodiscard]] Answer call_write(const Request& request);

}  // namespace npm
