//! \file
//! From sites to a mesh: dual, vertex count, positions, improvement.
#pragma once

#include "remesh/pipeline/remesh.h"
#include "remesh/placement/placement.h"

namespace remesh::detail {

struct CurvedSurface;
struct Domain;
struct InputCrossings;
struct PlacedSites;
struct StageContext;

struct BuiltMesh {
    PlacedMesh mesh = {};          //!< On the cleaned surface.
    std::vector<Index> site = {};  //!< #V until the mesh is improved: see DualMesh.
    Index num_wanted = 0;          //!< Vertices that were asked for.
    Index num_vertices = 0;        //!< To which the sites could be reduced.
    std::optional<CrossingCounts> self_intersections = {};  //!< Unset without CGAL.
    std::optional<double> proved_distance = {};  //!< See bring_near; unset: there is no bound.
    std::vector<ForcedFace> forced = {};         //!< See RemeshResult.
    //! Corners of the faces that intersect, the input's not; on the cleaned surface.
    std::vector<SurfacePoint> crossing_corners = {};
};

//! The dual of the sites with its exact number of vertices, and their positions.
//! \param domain  its layout is consumed.
//! \return false: no mesh has all curves and few enough vertices.
//! Cost: a propagation and a diagram, and those of placement.
[[nodiscard]] bool place_mesh(Domain& domain, const PlacedSites& sites, BuiltMesh& built,
                              const StageContext& context);

//! A mesh of the surface's vertices that are left when the others are gone by collapses of edges,
//! shortest first. None adds an intersection. Cost: O(n log n).
[[nodiscard]] BuiltMesh mesh_by_collapses(const CurvedSurface& curved, const StageContext& context);

//! Moves vertices of triangles that intersect back onto the surface, improves narrow triangles, and
//! brings the mesh within the bounds and the distance asked for, if that may be.
//! \param of_input  searched if the mesh intersects itself.
//! Cost: that of find_self_intersections, in a few rounds if there are any, improve and bring_near.
void finish_mesh(const CurvedSurface& curved, InputCrossings& of_input, const StageContext& context,
                 BuiltMesh& built);

}  // namespace remesh::detail
