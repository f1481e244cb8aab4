//! \file
//! From sites to a mesh: cells, dual, the exact count, flips to Delaunay, positions.
#pragma once

#include "remesh/pipeline/remesh.h"

namespace remesh::detail {

struct Domain;
struct InputCrossings;
struct PlacedSites;
struct StageContext;

struct BuiltMesh {
    TriangleMesh mesh;                  //!< Empty: no mesh has all curves and few enough vertices.
    std::vector<SurfacePoint> sites;    //!< #V, on the cleaned surface.
    std::vector<Index> first_of_group;  //!< #V: see GluedMesh; empty without junctions.
    Index num_wanted = 0;               //!< Vertices that were asked for.
    Index num_vertices = 0;             //!< To which the sites could be reduced.
    std::optional<CrossingCounts> self_intersections;  //!< Unset without CGAL.
    //! Corners of the faces that intersect, the input's not; on the cleaned surface.
    std::vector<SurfacePoint> crossing_corners;
};

//! Builds the mesh of the sites and improves its narrow triangles.
//! \param domain    its layout is consumed.
//! \param of_input  searched if the result intersects itself.
//! Cost: a propagation and a diagram, and those of placement.
[[nodiscard]] BuiltMesh build_mesh(Domain& domain, const PlacedSites& sites,
                                   InputCrossings& of_input, const StageContext& context);

}  // namespace remesh::detail
