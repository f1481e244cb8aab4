//! \file
//! How well a result keeps the sharp edges and corners of the original.
#pragma once

#include <optional>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh {

//! An edge is sharp if its two faces meet at more than 40 degrees or if it has more than two faces;
//! it is blunt above 25 degrees, so that an edge that is a little rounder in the other mesh is not
//! missed. Points with equal coordinates count as one.
//!
//! A face of the original lower than 1e-6 diagonals (of the result 1e-9) has no direction: its
//! edges take the normal of the face across its longest other side, so that slivers make no sharp
//! edges.
struct FeatureCoverage {
    double length = 0;  //!< Of the original's sharp edges, mesh units.
    //! Share of it within .1 % of the diagonal of the result's blunt edges; 1 if there is none.
    double covered = 1;
    double covered_closely = 1;  //!< Likewise, within .02 %.
    double result_length = 0;    //!< Of the result's sharp edges, mesh units.
    //! Share of it farther than .1 % of the diagonal from the original's blunt edges and boundary;
    //! 0 if there is none.
    double false_share = 0;
    //! Vertices of the original where three or more sharp or boundary edges meet, or two that turn
    //! by more than 45 degrees.
    Index corners = 0;
    Index corners_kept = 0;  //!< With a vertex of the result within .05 % of the diagonal.
    //! Corners where two of these edges meet at less than 30 degrees: a triangle between them
    //! cannot have a larger angle there.
    Index acute_corners = 0;
    //! Smallest angle of the result's triangles, radians, except those with a vertex within .05 %
    //! of the diagonal of an acute corner; pi if there is no other.
    double min_angle_elsewhere = 0;
    double diagonal = 0;  //!< Of the box around the original's faces, mesh units.
};

//! Measures how well a result keeps the sharp edges and corners of the original. Shares refer to 20
//! 000 points at equal distances along the edges.
//!
//! \param original, result  any triangles, manifold or not; indices in range, positions finite.
//! \return nothing if the original has neither sharp edges nor corners.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n log n).
[[nodiscard]] std::optional<FeatureCoverage> feature_coverage(const MeshView& original,
                                                              const MeshView& result,
                                                              const Progress& progress = {});

}  // namespace remesh
