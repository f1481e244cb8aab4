//! \file
//! How good the triangles of a mesh are.
#pragma once

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh {

//! Angles in radians, shares in [0, 1]. A face of area 0 has quality 0; its angles are 0 or pi.
struct TriangleQuality {
    //! Of Q = 6 / sqrt(3) * S / (p h): S area, p half the perimeter, h the longest edge. 1 for an
    //! equilateral triangle, 0 for a degenerate one ([frey1999]).
    double mean_quality = 0;
    double min_quality = 0;            //!< Of the worst triangle.
    double mean_min_angle = 0;         //!< Mean of the faces' smallest angles.
    double min_angle = 0;              //!< Radians.
    double max_angle = 0;              //!< Radians.
    double small_angle_share = 0;      //!< Faces whose smallest angle is below pi / 6.
    double regular_share = 0;          //!< Vertices of 6 edges, on the boundary of 4.
    double edge_length_variation = 0;  //!< Standard deviation over mean of the edge lengths.
    Index edges = 0;                   //!< #E.
    //! Inner edges whose two opposite angles (measured in space) sum to more than pi.
    Index non_delaunay_edges = 0;
    Index faces_without_area = 0;  //!< Flat up to rounding: see is_flat().
};

//! Measures any mesh, manifold or not. Edges with one face or more than two are not tested for the
//! Delaunay condition, and vertices in no face do not count.
//!
//! \param mesh  #V x 3 finite positions, #F x 3 indices in range; without faces all is 0.
//! Cost: O(n log n).
//! \throw Cancelled  the progress callback returned false.
[[nodiscard]] TriangleQuality measure_triangles(const MeshView& mesh,
                                                const Progress& progress = {});

}  // namespace remesh
