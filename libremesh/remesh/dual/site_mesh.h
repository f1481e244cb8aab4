//! \file
//! A triangulation of sites, and whether the triangles around each are a fan.
#pragma once

#include <cstdint>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/core/types.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Sites and their triangulation.
struct TriangulatedSites {
    std::vector<SurfacePoint> sites;
    std::vector<Triangle> triangles;
    std::vector<double> weights = {};  //!< #sites: their density; empty: all alike.
};

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

//! How the triangles around a site lie.
enum class Fan : std::uint8_t {
    Closed,  //!< One fan around it, of three or more.
    Open,    //!< One fan, between two edges of the rim.
    Broken,  //!< None, several fans, or two triangles of the same corners.
};
//! \return #sites. Cost: O(n).
[[nodiscard]] std::vector<Fan> find_fans(const SiteMesh& mesh);

}  // namespace remesh::detail
