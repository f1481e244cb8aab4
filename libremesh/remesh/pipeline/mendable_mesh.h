//! \file
//! Better triangles where placement leaves thin ones: along boundaries and in thinned components.
#pragma once

#include "remesh/pipeline/crossings.h"
#include "remesh/placement/placement.h"

namespace remesh::detail {

//! A mesh and which of its vertices mending may move.
struct MendableMesh {
    PlacedMesh mesh;
    std::vector<Mobility> mobility;  //!< #V
    std::vector<DirectedEdge> hard;  //!< The boundary.
};

//! Which vertices may move: those of components that were thinned or have a boundary. Corners of
//! the boundary that turn by more than 45 degrees over a whole spacing stay. Others, and those of
//! small holes, are no larger than the teeth that the triangles of a scan make at its rim; they may
//! move as far as repair_shape() moves the boundary.
//!
//! \param is_thinned  by component.
//! \return nothing if there is no such component. With given sites only thinned ones count: the
//!         vertices of others are those of the sites.
//! Cost: O(#base + #mesh).
[[nodiscard]] std::optional<MendableMesh> find_mendable(const Domain& domain, const ValidDual& dual,
                                                        PlacedMesh placed,
                                                        const std::vector<bool>& is_thinned,
                                                        const RemeshOptions& options);

struct MendedMesh {
    PlacedMesh mesh;
    std::optional<CrossingCounts> self_intersections;  //!< Unset without CGAL.
};

//! Mends thin triangles (repair_shape). If mended triangles intersect, fixes their corners and
//! tries again.
//!
//! \param most_crossings  self-intersecting pairs that the mesh may have; unset: not known.
//! \return nothing if no mended mesh is better.
//! Cost: that of repair_shape, twice at most.
[[nodiscard]] std::optional<MendedMesh> mend(const Domain& domain, MendableMesh mendable,
                                             std::optional<Index> most_crossings,
                                             CrossingFinder& finder, const StageContext& context);

}  // namespace remesh::detail
