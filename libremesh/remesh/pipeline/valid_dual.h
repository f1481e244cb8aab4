//! \file
//! From sites to a triangulation with the topology of the surface.
#pragma once

#include <span>
#include <vector>

#include "agvd/diagram/diagram.h"
#include "remesh/names.h"

namespace remesh::detail {

struct Domain;
struct PlacedSites;
struct StageContext;

//! A triangle mesh whose vertices are points of the base.
struct ValidDual {
    std::vector<SurfacePoint> points;      //!< One per vertex.
    std::vector<Triangle> triangles;       //!< Indices into points.
    std::vector<Index> site;               //!< Per vertex: its site; no_index: it has none.
    std::vector<std::uint8_t> stays = {};  //!< #V or empty: 1 for vertices to remove last.
    Diagram diagram;                       //!< Of the sites.
};

//! The dual of the cells. A patch whose dual has another topology or another rim than the patch is
//! simplified to its sites instead (simplify). For any sites each patch of the result is an
//! oriented manifold with the topology of the patch.
//! \param placed  the curves that the mesh must have.
//! \param sites   on the base.
//! Cost: a propagation and a diagram, and that of simplify for the patches that need it.
[[nodiscard]] ValidDual build_valid_dual(Domain& domain, const PlacedSites& placed,
                                         std::span<const SurfacePoint> sites,
                                         const StageContext& context);

}  // namespace remesh::detail
