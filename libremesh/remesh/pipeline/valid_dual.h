//! \file
//! Moves and adds sites until the dual of their cells has the topology of the surface.
#pragma once

#include <optional>

#include "agvd/diagram/diagram.h"
#include "agvd/propagation/propagate.h"
#include "remesh/curves/curve_sites.h"
#include "remesh/pipeline/remesh_options.h"
#include "remesh/pipeline/remesh_result.h"

namespace remesh::detail {

//! The surface that cells lie on, and what the dual must respect.
struct DualInput {
    const Surface& surface;  //!< That of the intrinsic triangulation.
    //! SurfaceLayout(surface) or none. The first propagation consumes it; later ones make their
    //! own, which takes a tenth of a round. It is larger than the surface.
    std::optional<SurfaceLayout>& layout;
    std::span<const ComponentTopology> components;
    std::span<const Index> component;         //!< #F of surface: index into components.
    std::span<const Index> boundary_corners;  //!< Boundary vertices that need a site.
    //! If the surface is cut along a network: the boundary that the mesh must have. Components
    //! whose cells do not give it are thinned.
    std::span<const ChainEdge> chain = {};
    bool has_locked = false;  //!< Edges of the chain are locked: all else gives way to them.
};

//! A triangle mesh whose vertices are points of the surface.
struct SurfaceMesh {
    std::vector<SurfacePoint> points;  //!< One per vertex.
    std::vector<Triangle> triangles;   //!< Indices into points.
};

struct ValidDual {
    SurfaceMesh mesh;         //!< Points of the intrinsic triangulation.
    std::vector<Index> site;  //!< Per vertex: its site; no_index: it has none.
    Diagram diagram;          //!< Of `sites`.
    //! Where cells of the first round wrapped around a thin part.
    std::vector<SurfacePoint> thin_places;
};

//! Propagates, checks cells on the boundary (Boundary::Keep) and the closed-ball property, and adds
//! or moves sites where they fail, until both hold. A component that still fails after the last
//! round, or would need several times the sites, is thinned to its first sites instead
//! (thin), without the added ones. For any sites each component of the result is an oriented
//! manifold with the topology of the component.
//!
//! \param sites   on input.surface; moved, and new ones are appended.
//! \param is_thinned  by component, empty at first: true for those thinned from the start because
//!                    their cells failed before; those that fail now are added.
//! \param result  its counts and times are added to.
//! Cost: a propagation and a diagram per round.
[[nodiscard]] ValidDual build_valid_dual(const DualInput& input, std::vector<SurfacePoint>& sites,
                                         std::vector<bool>& is_thinned,
                                         const RemeshOptions& options, RemeshResult& result);

}  // namespace remesh::detail
