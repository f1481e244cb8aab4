//! \file
//! All of libagvd that users need, but for meshes in arrays of others (agvd/mesh/arrays.h).
#pragma once

#include "agvd/core/error.h"
#include "agvd/core/version.h"
#include "agvd/diagram/cut_cells.h"
#include "agvd/diagram/diagram.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/cut_surface.h"
#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "agvd/paths/distances.h"
#include "agvd/paths/geodesic_path.h"
#include "agvd/paths/isolines.h"
#include "agvd/propagation/propagate.h"
