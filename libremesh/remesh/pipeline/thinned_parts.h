//! \file
//! Better triangles for thinned components.
#pragma once

#include "remesh/pipeline/crossings.h"
#include "remesh/placement/edited_mesh.h"

namespace remesh::detail {

//! A mesh with thinned components, as mending needs it.
struct ThinnedParts {
    PlacedMesh mesh;                 //!< The whole mesh.
    std::vector<Mobility> mobility;  //!< #V: vertices of other components are fixed.
    std::vector<DirectedEdge> hard;  //!< The boundary.
};

//! \param is_thinned  by component. \param is_corner  #V of the base: needs a vertex.
[[nodiscard]] ThinnedParts find_thinned_parts(const Domain& domain, const ValidDual& dual,
                                              PlacedMesh placed,
                                              const std::vector<bool>& is_thinned,
                                              const std::vector<bool>& is_corner);

struct MendedMesh {
    PlacedMesh mesh;
    std::optional<agvd::Index> self_intersections;  //!< Pairs of faces; unset without CGAL.
};

//! Mends the triangles of thinned components (mend_shape). If mended triangles intersect, fixes
//! their corners and tries again.
//!
//! \param most_crossings  self-intersecting pairs that the mesh may have; unset: not known.
//! \return nothing if no mended mesh is better.
//! Cost: that of mend_shape, twice at most.
[[nodiscard]] std::optional<MendedMesh> mend_thinned(const Domain& domain, ThinnedParts parts,
                                                     std::optional<agvd::Index> most_crossings,
                                                     CrossingFinder& finder,
                                                     const StageContext& context);

}  // namespace remesh::detail
