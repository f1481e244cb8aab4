//! \file
//! Removes the vertices of a mesh of sites that are no sites, and changes nothing else.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Removes vertices one by one (simplify_patch). What changes are the triangles around them, or
//! those within more edges where that is too few. Vertices that cannot be removed stay, as do those
//! of components that are no mesh.
//! \param positions  #V, mesh units: lengths are those of straight edges. The sites come first.
//! \param num_sites  vertices from here on are removed.
//! \param triangles  edited in place.
//! \return how many parts were simplified. Cost: that of simplify() for each part.
Index simplify_narrow(std::span<const Vec3> positions, Index num_sites,
                      std::vector<Triangle>& triangles, Ticker ticker);

}  // namespace remesh::detail
