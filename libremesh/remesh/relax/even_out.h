//! \file
//! Repairs starts that are far from even.
#pragma once

#include <span>
#include <vector>

#include "remesh/relax/prepared_surface.h"

namespace remesh::detail {

//! Moves sites from where there are too many to where there are too few, so that relaxation need
//! not carry them there: a Lloyd step evens out neighbours, and what is uneven over w cells takes
//! some w^2 steps. The surface is divided into regions of about one size, large ones first; where
//! the sites are spread over these less evenly than random points would be, random ones of the
//! crowded regions go to random places of the others. Sites that lie on another one, which no
//! relaxation can part, go first. Starts as even as random ones stay as they are.
//!
//! Sites on the boundary stay. Components keep their numbers unless these are further from their
//! share than chance would bring them.
//! \param surface   regions are made of its base's faces.
//! \param sites     on surface.input().
//! \param is_fixed  #sites: 1 for sites that stay; or empty.
//! \return  the number of sites moved.
//! \throw agvd::Cancelled  the progress callback returned false; `sites` is of no use then.
//! Cost: O(n log n), a few sweeps over the edges.
agvd::Index even_out(const PreparedSurface& surface, std::vector<agvd::SurfacePoint>& sites,
                     std::span<const std::uint8_t> is_fixed, int num_threads,
                     const agvd::Progress& progress = {});

}  // namespace remesh::detail
