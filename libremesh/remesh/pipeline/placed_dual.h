//! \file
//! Positions for the vertices of a dual, and the patches between curves as one mesh.
#pragma once

#include "remesh/curves/curve_sites.h"
#include "remesh/curves/glue.h"
#include "remesh/placement/placement.h"

namespace remesh::detail {

struct CurvedSurface;
struct Domain;
struct StageContext;
struct ValidDual;

//! How the patches of a dual are joined.
struct JoinedPatches {
    std::vector<Index> group;  //!< #V of the dual: equal for the copies of one vertex.
    GluedMesh glued;
};

//! A dual with positions in space.
struct PlacedDual {
    PlacedMesh mesh;                       //!< Vertices on curves have a copy for each patch.
    std::optional<JoinedPatches> patches;  //!< Unset: they are joined in `mesh`.
};

//! Whether each curve is the same chain of edges in all patches on its sides. Edges of the boundary
//! may have vertices between their ends. Cost: O(n log n).
[[nodiscard]] bool has_chain(const Domain& domain, std::span<const ChainEdge> chain,
                             const ValidDual& dual);

//! Divides the inner edges of patches that would coincide with other edges when patches are joined,
//! and that no flip removes, by a vertex in the middle.
//! \param points  #V of the dual, on the cleaned surface.
//! \return how many. Cost: O(n log n).
Index split_repeated(const Domain& domain, const CurveSites& curves,
                     std::vector<SurfacePoint> points, ValidDual& dual);

//! Adds vertices in the middle of the longest inner edges.
//! \param points  #V of the dual, on the cleaned surface. Cost: O(n log n).
void add_vertices(const Domain& domain, std::vector<SurfacePoint> points, Index count,
                  ValidDual& dual);

//! Joins the patches, fits the vertices to the surface and moves those of bad triangles, as far as
//! the options ask for it, and flips triangles without area.
//! \param domain  its pieces are found if they were reset, and reset then.
//! \param points  #V of the dual: where each vertex lies on the cleaned surface.
//! Cost: that of glue, fit_vertices.
[[nodiscard]] PlacedDual place_dual(Domain& domain, const CurveSites& curves, const ValidDual& dual,
                                    std::vector<SurfacePoint> points, const StageContext& context);

//! The result: copies of a vertex are joined, and sheets have equal points where they meet.
[[nodiscard]] TriangleMesh whole_mesh(const Surface& whole, const PlacedDual& placed);

//! The same to search for self-intersections: sheets share vertices where they meet, and so do
//! parts at locked positions. Some vertices may be in no triangle.
[[nodiscard]] TriangleMesh welded_mesh(const CurvedSurface& curved, const PlacedDual& placed);

//! The triangles with the first vertex at its position in place of each vertex. Cost: O(n).
[[nodiscard]] std::vector<Triangle> join_positions(const MeshView& mesh);

}  // namespace remesh::detail
