//! \file
//! Better triangles where placement leaves narrow ones.
#pragma once

#include "remesh/pipeline/placed_dual.h"
#include "remesh/pipeline/remesh.h"

namespace remesh::detail {

class CrossingFinder;
struct Domain;
struct StageContext;

//! A mesh and which of its vertices improvement may move.
struct ImprovableMesh {
    PlacedMesh mesh;
    std::vector<Mobility> mobility;  //!< #V
    std::vector<DirectedEdge> hard;  //!< Along the curves.
};

//! All vertices may move but those at nodes of the network, which may only be merged with others.
//! Those on a curve slide along it.
//! \return nothing with given sites, whose vertices stay, where sheets meet, and with
//!         VertexCount::Add.
//! Cost: O(#surface + #mesh).
[[nodiscard]] std::optional<ImprovableMesh> find_improvable(const Domain& domain,
                                                            const PlacedDual& placed,
                                                            const RemeshOptions& options);

//! Improves narrow triangles (repair_shape). If more of the improved triangles intersect than
//! before, fixes their corners and tries again, once.
//! \param improvable   its mesh becomes the improved one.
//! \param crossings  of the mesh, then of the improved one; unset without CGAL.
//! \return false: no improved mesh is better, and `crossings` is as before.
//! Cost: that of repair_shape, twice at most.
[[nodiscard]] bool improve(const Domain& domain, CrossingFinder& finder, ImprovableMesh& improvable,
                           std::optional<CrossingCounts>& crossings, const StageContext& context);

}  // namespace remesh::detail
