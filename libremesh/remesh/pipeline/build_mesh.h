//! \file
//! From sites to a mesh: cells, dual, the exact count, flips to Delaunay, positions.
#pragma once

#include "remesh/pipeline/remesh.h"

namespace remesh::detail {

class WorkLimit;
struct Domain;
struct PlacedSites;
struct StageContext;

//! Thrown if not all curves of the network could be reproduced.
struct NetworkFailed {};

struct BuiltMesh {
    TriangleMesh mesh;
    std::vector<SurfacePoint> sites;    //!< #V, on the cleaned surface.
    std::vector<Index> first_of_group;  //!< #V: see GluedMesh; empty without junctions.
    Index num_wanted = 0;               //!< Vertices that were asked for.
    std::optional<CrossingCounts> self_intersections;  //!< Unset without CGAL.
    std::vector<Vec3> crossing_corners;  //!< Corners of the faces that intersect, the input's not.
    std::vector<SurfacePoint> narrow_points;  //!< On the cleaned surface: see ValidDual.
};

//! Builds the mesh of the sites. While it self-intersects more often than the input, and where that
//! does not, builds it again with more sites there. Improves narrow triangles of the best mesh.
//! \param domain  its layout is consumed.
//! \param work    counts the rounds. A round that adds sites has to fit into it.
//! \throw TooFewSamples, or NetworkFailed if there is a plan.
//! Cost: a propagation and a diagram for each round of build_valid_dual.
[[nodiscard]] BuiltMesh build_mesh(Domain& domain, const PlacedSites& sites, WorkLimit& work,
                                   const StageContext& context);

}  // namespace remesh::detail
