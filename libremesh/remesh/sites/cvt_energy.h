//! \file
//! The energy of the centroidal Voronoi tessellation on a triangulation of the sites.
#pragma once

#include <span>
#include <vector>

#include "remesh/dual/site_mesh.h"

namespace remesh::detail {

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
