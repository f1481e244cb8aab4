//! \file
//! Moves and adds sites until the dual of their cells has the topology of the surface.
#pragma once

#include <optional>
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
    //! Where cells of the first round wrapped around a narrow part.
    std::vector<SurfacePoint> narrow_points;
};

//! Checks cells on the boundary (Boundary::Keep) and the closed-ball property, and adds or moves
//! sites where they fail, until both hold. A component that still fails after the last round, or
//! would need several times the sites, is simplified to its first sites (simplify). So is each
//! patch between curves that fails at all: more sites do not help there. For any sites each
//! component of the result is an oriented manifold with the topology of the component.
//! \param placed  boundary vertices that need a site, and the boundary that the mesh must have.
//! \param layout  of the base, or none. The first propagation consumes it.
//! \param sites   on the base; moved, and new ones are appended.
//! \param is_simplified  by component, empty at first: those to simplify from the start because their
//!                    cells failed before; those that fail now are added.
//! Cost: a propagation and a diagram per round.
[[nodiscard]] ValidDual build_valid_dual(const Domain& domain, const PlacedSites& placed,
                                         std::optional<SurfaceLayout>& layout,
                                         std::vector<SurfacePoint>& sites,
                                         std::vector<bool>& is_simplified,
                                         const StageContext& context);

}  // namespace remesh::detail
