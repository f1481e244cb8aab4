//! \file
//! Meshes that keep a distance from the input.
#pragma once

#include "agvd/mesh/closest_point.h"
#include "remesh/pipeline/improvable_mesh.h"

namespace remesh::detail {

//! A distance that a mesh is to keep from the cleaned input.
struct DistanceBound {
    MeshView input;
    const ClosestPointTree& tree;  //!< Of the input.
    double limit;                  //!< > 0, mesh units.
    //! #E of the cleaned surface: creases, and edges that the distance needs; empty: only creases.
    std::span<const std::uint8_t> hinges = {};
};

//! Brings a mesh within the distance, and takes vertices away where it is much nearer
//! (keep_distance).
//! \param curved  with a bound, and without junctions.
//! \return the largest distance at the points looked at, mesh units; unset: it is not proved.
//! Cost: that of keep_distance.
[[nodiscard]] std::optional<double> bring_near(const CurvedSurface& curved, PlacedMesh& mesh,
                                               const StageContext& context);

}  // namespace remesh::detail
