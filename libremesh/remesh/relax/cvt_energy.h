//! \file
//! The energy of a centroidal Voronoi tessellation, and its slope.
#pragma once

#include <span>

#include "remesh/relax/site_mesh.h"

namespace remesh::detail {

//! Of the Voronoi diagram of the sites on their triangulation, taken as a surface of its own.
struct CvtEnergy {
    double energy = 0;                //!< Sum over the cells of the integral of |x - site|^2.
    double weighted = 0;              //!< The same by density.
    std::vector<agvd::Vec3> slope;    //!< #sites: of that.
    std::vector<double> mass;         //!< #sites: weighted areas of the cells.
    std::vector<double> area;         //!< #sites: areas of the cells.
    std::vector<agvd::Vec3> normal;   //!< #sites: of the triangles around, of length 1.
    std::vector<double> cotangent;    //!< #H: of the angle opposite.
    std::vector<agvd::Index> turned;  //!< Triangles that face against the surface.
};

//! Fills `result`, whose memory is used again.
//!
//! \param mesh    Delaunay or nearly so: where a circumcentre lies outside of its triangle, areas
//!                are negative and neighbours make up for them.
//! \param facing  #sites: normals of the surface.
//! \param weight  #sites: density, > 0; linear in between.
//! Slopes are tangential: at right angles to `normal`.
//! Cost: O(n).
void measure_energy(const SiteMesh& mesh, std::span<const agvd::Vec3> positions,
                    std::span<const agvd::Vec3> facing, std::span<const double> weight,
                    CvtEnergy& result);

}  // namespace remesh::detail
