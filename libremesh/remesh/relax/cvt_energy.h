//! \file
//! The energy of a centroidal Voronoi tessellation, and its slope.
#pragma once

#include <span>

#include "remesh/relax/site_mesh.h"

namespace remesh::detail {

//! Of the Voronoi diagram of the sites on their triangulation, taken as a surface of its own.
struct CvtEnergy {
    struct Cell {
        agvd::Vec3 slope;   //!< Of `weighted`; tangential: at right angles to `normal`.
        agvd::Vec3 normal;  //!< Of the triangles around, of length 1.
        double mass;        //!< Weighted area.
        double area;
    };
    //! Sum over the cells of the integral of |x - site|^2; without flat triangles.
    double energy = 0;
    double weighted = 0;            //!< The same by density.
    std::vector<Cell> cells;        //!< #sites
    std::vector<double> cotangent;  //!< #H: of the angle opposite.
};

//! Fills `result`, whose memory is used again.
//!
//! \param mesh    Delaunay or nearly so: where a circumcentre lies outside of its triangle, areas
//!                are negative and neighbours make up for them.
//! \param weight  #sites: density, > 0; linear in between.
//! \param clips_at_rim  cells end at the rim of the triangulation. Otherwise that of a site near it
//!                reaches beyond, which draws the site out.
//! Cost: O(n).
void measure_energy(const SiteMesh& mesh, std::span<const agvd::Vec3> positions,
                    std::span<const double> weight, bool clips_at_rim, agvd::Ticker& ticker,
                    CvtEnergy& result);

//! Fills `turned` with the triangles that face against the surface or have no area, ascending.
//!
//! \param facing  #sites: normals of the surface.
//! Cost: O(n).
void find_turned(const SiteMesh& mesh, std::span<const agvd::Vec3> positions,
                 std::span<const agvd::Vec3> facing, std::vector<agvd::Index>& turned);

}  // namespace remesh::detail
