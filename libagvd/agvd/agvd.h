//! \file
//! All of libagvd that users need, but for meshes in arrays of other programs (mesh/arrays.h) and the
//! oracle (paper/oracle.h, paper/compare.h).
#pragma once

#include "agvd/core/error.h"
#include "agvd/core/version.h"
#include "agvd/diagram/build_diagram.h"
#include "agvd/diagram/cells.h"
#include "agvd/diagram/diagram_on_input.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface.h"
#include "agvd/propagation/propagate.h"
