//! \file
//! Better triangles where placement leaves narrow ones.
#pragma once

#include "remesh/pipeline/placed_dual.h"
#include "remesh/pipeline/remesh.h"

namespace remesh::detail {

class CrossingFinder;
struct CurvedSurface;
struct StageContext;

//! A mesh whose patches are joined, and its edges along the curves.
struct JoinedMesh {
    PlacedMesh mesh;
    std::vector<DirectedEdge> hard;        //!< Those of the boundary included.
    std::vector<std::uint8_t> stays = {};  //!< #V: 1 for vertices that do not move; empty: none.
};

//! Joins the patches of a mesh. Cost: O(n log n).
[[nodiscard]] JoinedMesh joined_mesh(const PlacedDual& placed);

//! Whether vertices may move: not with given sites, whose vertices stay, and where sheets meet.
[[nodiscard]] bool is_improvable(const CurvedSurface& curved, const RemeshOptions& options);

//! #V: all vertices may move but those at nodes of the network, which may only be merged with
//! others, or stay if something is locked. Those on a curve slide along it. Cost: O(#mesh log
//! #curves).
[[nodiscard]] std::vector<Mobility> find_mobility(const CurvedSurface& curved,
                                                  const MeshCurves& curves,
                                                  const JoinedMesh& joined);

//! Improves narrow triangles (repair_shape). If more of the improved triangles intersect than
//! before, fixes their corners and tries again, once.
//! \param joined  its mesh becomes the improved one.
//! \param crossings  of the mesh, then of the improved one; unset without CGAL.
//! \return false: no improved mesh is better, and `crossings` is as before.
//! Cost: O(#surface), and that of repair_shape, twice at most.
[[nodiscard]] bool improve(const CurvedSurface& curved, CrossingFinder& finder, JoinedMesh& joined,
                           std::optional<CrossingCounts>& crossings, const StageContext& context);

//! Improves the bad triangles of a mesh that is large, or a tile of one: only what lies within some
//! rings of them is looked at and changed. Crossings are not searched. Vertices that stay keep
//! their numbers; `hard` is not kept up. Cost: O(#surface), and that of repair_shape there.
void improve_in_places(const CurvedSurface& curved, JoinedMesh& joined,
                       const StageContext& context);

}  // namespace remesh::detail
