//! \file
//! Removes the vertices of a merged mesh that are no sites.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh::detail {

//! A surface with some vertices merged into sites. Its vertices are numbered: first the sites, then
//! vertices of the surface that stay.
struct MergedMesh {
    std::span<const Triangle> triangles;  //!< Of numbers.
    std::span<const Index> vertex;        //!< Of the surface, by number from #sites on.
};

//! Replaces the triangles of the components that have vertices besides sites: these are removed one
//! by one (simplify_patch). The geometry is that of straight edges between the vertices; where the
//! merged mesh is none, as an edge of the surface may have equal ends or come twice, the surface
//! itself is simplified. Triangles of vertices that cannot be removed are left out.
//! \param sites      on the surface.
//! \param triangles  of sites; edited in place.
//! \return the number of such components. Cost: O(n log n), that of simplify_patch for each.
[[nodiscard]] Index simplify_merged(const Surface& surface, std::span<const SurfacePoint> sites,
                                    const MergedMesh& merged, std::vector<Triangle>& triangles,
                                    Ticker ticker);

}  // namespace remesh::detail
