//! \file
//! Better triangles where placement leaves narrow ones: along boundaries and in simplified
//! components.
#pragma once

#include "remesh/pipeline/remesh.h"
#include "remesh/placement/placement.h"

namespace remesh::detail {

class CrossingFinder;
struct Domain;
struct StageContext;
struct ValidDual;

//! A mesh and which of its vertices improvement may move.
struct ImprovableMesh {
    PlacedMesh mesh;
    std::vector<Mobility> mobility;  //!< #V
    std::vector<DirectedEdge> hard;  //!< The boundary.
};

//! Vertices may move in components that were simplified or have a boundary. Corners of the boundary
//! that turn by more than 45 degrees over a whole spacing stay. Others, and those of small holes,
//! may be no more than the teeth of a rough rim, and move.
//! \param is_simplified  by component.
//! \return nothing if there is no such component. With given sites only simplified ones count: the
//!         vertices of others are those of the sites.
//! Cost: O(#base + #mesh).
[[nodiscard]] std::optional<ImprovableMesh> find_improvable(const Domain& domain,
                                                            const ValidDual& dual,
                                                            PlacedMesh placed,
                                                            const std::vector<bool>& is_simplified,
                                                            const RemeshOptions& options);

//! Improves narrow triangles (repair_shape). If more of the improved triangles intersect than
//! before, fixes their corners and tries again.
//! \param improvable   its mesh becomes the improved one.
//! \param crossings  of the mesh, then of the improved one; unset without CGAL.
//! \return false: no improved mesh is better, and `crossings` is as before.
//! Cost: that of repair_shape, twice at most.
[[nodiscard]] bool improve(const Domain& domain, CrossingFinder& finder, ImprovableMesh& improvable,
                           std::optional<CrossingCounts>& crossings, const StageContext& context);

}  // namespace remesh::detail
