//! \file
//! From sites to a mesh: cells, dual, the exact count, flips to Delaunay, positions.
#pragma once

#include "remesh/pipeline/remesh.h"
#include "remesh/placement/placement.h"

namespace remesh::detail {

struct CurvedSurface;
struct Domain;
struct InputCrossings;
struct PlacedDual;
struct PlacedSites;
struct StageContext;

struct BuiltMesh {
    TriangleMesh mesh;                  //!< Empty: no mesh has all curves and few enough vertices.
    std::vector<SurfacePoint> sites;    //!< #V, on the cleaned surface.
    std::vector<Index> first_of_group;  //!< #V: see GluedMesh; empty without junctions.
    Index num_wanted = 0;               //!< Vertices that were asked for.
    Index num_vertices = 0;             //!< To which the sites could be reduced.
    std::optional<CrossingCounts> self_intersections;  //!< Unset without CGAL.
    std::optional<double> proved_distance;  //!< See bring_near; unset: there is no bound.
    //! Corners of the faces that intersect, the input's not; on the cleaned surface.
    std::vector<SurfacePoint> crossing_corners;
};

//! The dual of the sites with its exact number of vertices, and their positions.
//! \param domain  its layout is consumed.
//! \param built   its numbers of vertices are set.
//! \return unset: no mesh has all curves and few enough vertices.
//! Cost: a propagation and a diagram, and those of placement.
[[nodiscard]] std::optional<PlacedDual> place_mesh(Domain& domain, const PlacedSites& sites,
                                                   BuiltMesh& built, const StageContext& context);

//! Moves vertices of triangles that intersect back onto the surface, and sets `built` to the mesh.
//! \param of_input  searched if the mesh intersects itself.
//! Cost: that of find_self_intersections, in a few rounds if there are any.
void finish_mesh(const CurvedSurface& curved, PlacedMesh mesh, InputCrossings& of_input,
                 const StageContext& context, BuiltMesh& built);

//! Builds the mesh of the sites and improves its narrow triangles.
//! \param domain    its layout is consumed.
//! \param of_input  searched if the result intersects itself.
//! Cost: a propagation and a diagram, and those of placement.
[[nodiscard]] BuiltMesh build_mesh(Domain& domain, const PlacedSites& sites,
                                   InputCrossings& of_input, const StageContext& context);

}  // namespace remesh::detail
