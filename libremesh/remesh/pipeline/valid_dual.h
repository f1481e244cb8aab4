//! \file
//! Sites, moved and added until their cells give a mesh of the surface's topology; and that mesh.
#pragma once

#include <optional>

#include "agvd/diagram/diagram.h"
#include "agvd/propagation/surface_layout.h"
#include "remesh/features/curve_sites.h"
#include "remesh/pipeline/remesh_options.h"
#include "remesh/pipeline/remesh_result.h"

namespace remesh::detail {

//! The surface that cells lie on, and what the dual must respect.
struct DualInput {
    const agvd::Surface& surface;  //!< That of the intrinsic triangulation.
    //! SurfaceLayout(surface) or none: the first propagation uses it up, and others make their own,
    //! which takes a tenth of a round. It is larger than the surface.
    std::optional<agvd::SurfaceLayout>& layout;
    std::span<const ComponentTopology> components;
    std::span<const agvd::Index> component;  //!< #F of it: index into components.
    std::span<const agvd::Index> corners;    //!< Boundary vertices that need a site.
    //! Of a network that the surface is cut along: the boundary that the mesh must have. Components
    //! whose cells do not give it are thinned.
    std::span<const ChainEdge> chain = {};
};

//! A triangle mesh whose vertices are points of the surface.
struct SurfaceMesh {
    std::vector<agvd::SurfacePoint> points;  //!< One per vertex.
    std::vector<agvd::Triangle> triangles;   //!< Indices into points.
};

struct ValidDual {
    SurfaceMesh mesh;               //!< Points of the intrinsic triangulation.
    std::vector<agvd::Index> site;  //!< Per vertex: its site; no_index: it is none.
    agvd::Diagram diagram;          //!< Of `sites`.
};

//! Propagates, checks cells on the boundary (Boundary::Keep) and the closed-ball property, and adds
//! or moves sites where they fail, until both hold. A component where they still fail once the
//! rounds are over, or where that would take several times the sites, is thinned to its first sites
//! instead (agvd::thin), those added in vain are gone then. Whatever the sites, each component of
//! the result is an oriented manifold of its topology.
//!
//! \param sites   on input.surface; changed: moved, and new ones at the end.
//! \param is_thinned  by component, empty at first: which are thinned from the start, since cells
//!                    have failed there before; those that fail now are added.
//! \param result  its counts and times are added to.
//! Cost: a propagation and a diagram per round.
[[nodiscard]] ValidDual build_valid_dual(const DualInput& input,
                                         std::vector<agvd::SurfacePoint>& sites,
                                         std::vector<bool>& is_thinned,
                                         const RemeshOptions& options, RemeshResult& result);

}  // namespace remesh::detail
