//! \file
//! From sites to a triangulation with the topology of the surface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "agvd/core/types.h"
#include "agvd/mesh/mesh.h"
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
    std::vector<std::uint8_t> has_cell;    //!< #sites: 1 for those that own a part of the surface.
    std::vector<Index> nearest_site;       //!< #V of the base: a site nearby; no_index: none.
    bool is_of_cells = false;              //!< Its patches are duals of cells, or simplified.
};

//! Triangles of the sites. Of cells, too, if labels do not give all patches their topology and
//! rims, the sites are not relaxed, faces are too large for labels, or the options ask for an
//! engine, an error or other flips. A patch whose dual is not right is simplified to its sites
//! (simplify). For any sites each patch of the result is an oriented manifold with the topology of
//! the patch.
//! \param placed  the curves that the mesh must have.
//! \param sites   on the base.
//! Cost: that of label_vertices; for the dual a propagation and a diagram, and that of simplify for
//! the patches that need it.
[[nodiscard]] ValidDual build_valid_dual(Domain& domain, const PlacedSites& placed,
                                         std::span<const SurfacePoint> sites,
                                         const StageContext& context);

}  // namespace remesh::detail
