//! \file
//! Keeps a mesh within a distance of an input.
#pragma once

#include <optional>

#include "remesh/placement/far_points.h"
#include "remesh/placement/placement.h"

namespace remesh::detail {

//! How far a mesh may be from an input. Lengths in mesh units.
struct DistanceLimit {
    SearchedMesh input;
    std::vector<Vec3> points = {};  //!< Of the input, that are compared with the mesh.
    double limit = 0;               //!< > 0.
    bool may_leave_surface = true;  //!< Whether vertices may lie off the surface.
    double least_edge = 0;          //!< No edge is divided into shorter ones ...
    double most_edge = infinity;    //!< ... or gets longer.
    ShapeBounds bounds = {};        //!< No triangle that keeps them is changed to exceed them.
    int num_threads = 1;            //!< >= 0; 0: all cores. The result is the same for any number.
};

//! Where a mesh is farther from an input than a limit, moves vertices off the surface and divides
//! edges. Vertices go where it is much nearer. Nothing else of the mesh changes. Topology and
//! chains of hard edges stay, and no intersections are added.
//! \param curves, mobility  see repair_shape().
//! \throw Cancelled  the progress callback returned false; `mesh` is unchanged.
//! \return the largest distance at the points looked at, both ways, mesh units, if it is proved that
//! no point of either surface is farther from the other one than the limit; else unset.
//! Cost: O((n + length of all edges / limit) log n), and about a millisecond for each face that is
//! too far and each vertex that goes.
[[nodiscard]] std::optional<double> keep_distance(const MeshCurves& curves,
                                                  std::span<const Mobility> mobility,
                                                  const DistanceLimit& limit, PlacedMesh& mesh,
                                                  const Progress& progress);

}  // namespace remesh::detail
