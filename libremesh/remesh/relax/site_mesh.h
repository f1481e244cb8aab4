//! \file
//! A triangulation of the sites, which gives relaxation their neighbours.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/half_edge.h"
#include "agvd/core/poller.h"

namespace remesh::detail {

//! Half-edge h = 3 t + k runs from corner k to corner k + 1 of triangle t.
struct SiteMesh {
    std::vector<agvd::Triangle> triangles;
    std::vector<agvd::Index> twin;     //!< #H; no_index: none, or more than two meet.
    std::vector<std::uint8_t> is_rim;  //!< #sites: 1 where the triangles around do not close.

    [[nodiscard]] static constexpr agvd::Index next(agvd::Index h) {
        return agvd::next_half_edge(h);
    }
    [[nodiscard]] static constexpr agvd::Index previous(agvd::Index h) {
        return agvd::previous_half_edge(h);
    }
    [[nodiscard]] agvd::Index tail(agvd::Index h) const { return triangles[h / 3][h % 3]; }
    [[nodiscard]] agvd::Index head(agvd::Index h) const { return tail(next(h)); }
};

//! Accepts any triangles of site indices, manifold or not. Cost: O(n log n).
[[nodiscard]] SiteMesh build_site_mesh(std::vector<agvd::Triangle> triangles, agvd::Index num_sites,
                                       agvd::Ticker ticker = {});

//! Flips the edges whose opposite angles (in space) sum to more than pi, unless that would fold the
//! mesh or join two sites twice. Edges that fail only after another flip wait for the next call.
//!
//! \param cotangent  #H: of the angle opposite, as it is now.
//! Returns the number of flips. Cost: O(n).
agvd::Index flip_towards_delaunay(SiteMesh& mesh, std::span<const agvd::Vec3> positions,
                                  std::span<const double> cotangent, agvd::Ticker ticker = {});

}  // namespace remesh::detail
