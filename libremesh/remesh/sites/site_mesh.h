//! \file
//! A triangulation of the sites, which gives relaxation their neighbours.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Half-edge h = 3 t + k runs from corner k to corner k + 1 of triangle t.
struct SiteMesh {
    std::vector<Triangle> triangles;
    std::vector<Index> twin;           //!< #H; no_index: none, or more than two meet.
    std::vector<std::uint8_t> is_rim;  //!< #sites: 1 where the triangles around do not close.

    [[nodiscard]] static constexpr Index next(Index h) { return next_half_edge(h); }
    [[nodiscard]] static constexpr Index previous(Index h) { return previous_half_edge(h); }
    [[nodiscard]] Index tail(Index h) const { return triangles[h / 3][h % 3]; }
    [[nodiscard]] Index head(Index h) const { return tail(next(h)); }
};

//! Accepts any triangles of site indices, manifold or not. Cost: O(n log n).
[[nodiscard]] SiteMesh build_site_mesh(std::vector<Triangle> triangles, Index num_sites,
                                       Ticker ticker = {});

//! Flips the edges whose opposite angles (in space) sum to more than pi, unless that would fold the
//! mesh or join two sites twice. Edges that fail only after another flip wait for the next call.
//!
//! \param cotangent  #H: of the angle opposite, as it is now.
//! Returns the number of flips. Cost: O(n).
Index flip_towards_delaunay(SiteMesh& mesh, std::span<const Vec3> positions,
                            std::span<const double> cotangent, Ticker ticker = {});

}  // namespace remesh::detail
