//! \file
//! Redistributes sites that are far from even.
#pragma once

#include <span>
#include <vector>

#include "remesh/sites/prepared_surface.h"

namespace remesh::detail {

//! Moves sites from crowded regions to sparse ones, which would take relaxation long: a Lloyd step
//! evens out neighbours only, and unevenness over w cells takes some w^2 steps. The surface is
//! divided into regions of similar size, large ones first. If the sites are spread over these less
//! evenly than random points, random sites of crowded regions move to random places of the others.
//! Sites at the place of another one, which relaxation cannot separate, move first. Starts as even
//! as random ones do not change.
//!
//! Sites on the boundary stay. A component keeps its number of sites unless that is further from
//! its share than chance explains.
//! \param surface   regions consist of its base's faces.
//! \param sites     on surface.input().
//! \param is_fixed  #sites: 1 for sites that stay; or empty.
//! \param sizes     areas count in squares of the local length; null: in mesh units.
//! \return  the number of sites moved.
//! \throw Cancelled  the progress callback returned false; `sites` is unspecified then.
//! Cost: O(n log n), a few sweeps over the edges.
Index even_out(const PreparedSurface& surface, std::vector<SurfacePoint>& sites,
               std::span<const std::uint8_t> is_fixed, int num_threads,
               const Progress& progress = {}, const SizeField* sizes = nullptr);

}  // namespace remesh::detail
