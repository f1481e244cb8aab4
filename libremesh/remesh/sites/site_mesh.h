//! \file
//! A triangulation of the sites, which gives relaxation their neighbours, and the energy of the
//! centroidal Voronoi tessellation on it.
#pragma once

#include <span>
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

//! Flips the edges whose opposite angles (in space) sum to more than pi, unless that would fold the
//! mesh or join two sites twice. Edges that fail only after another flip wait for the next call.
//! \param cotangent  #H: of the angle opposite, as it is now.
//! Returns the number of flips. Cost: O(n).
Index flip_towards_delaunay(SiteMesh& mesh, std::span<const Vec3> positions,
                            std::span<const double> cotangent, Ticker ticker = {});

//! The energy of the Voronoi diagram of the sites on their triangulation, which is taken as a
//! surface of its own: cells end at its rim.
struct CvtEnergy {
    struct Cell {
        Vec3 slope;   //!< Gradient of `weighted`; tangential, perpendicular to `normal`.
        Vec3 normal;  //!< Unit normal of the triangles around, by area.
        double mass;  //!< Weighted area.
        double area;
    };
    //! Sum over the cells of the integral of |x - site|^2; without nearly degenerate triangles.
    double energy = 0;
    double weighted = 0;            //!< The same, weighted by density.
    std::vector<Cell> cells;        //!< #sites
    std::vector<double> cotangent;  //!< #H: of the angle opposite.
};

//! Fills `result` and reuses its memory.
//! \param mesh    Delaunay or nearly so: a circumcentre outside its triangle gives negative areas,
//!                for which neighbours compensate.
//! \param weight  #sites: density, > 0; linear in between.
//! Cost: O(n).
void measure_energy(const SiteMesh& mesh, std::span<const Vec3> positions,
                    std::span<const double> weight, Ticker& ticker, CvtEnergy& result);

//! Fills `turned` with the triangles that face against the surface or are degenerate, ascending.
//! \param facing  #sites: normals of the surface.
//! Cost: O(n).
void find_turned(const SiteMesh& mesh, std::span<const Vec3> positions,
                 std::span<const Vec3> facing, std::vector<Index>& turned);

}  // namespace remesh::detail
