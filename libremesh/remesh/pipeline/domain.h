//! \file
//! The surface on which sites lie, and what is prepared on it.
#pragma once

#include "agvd/mesh/closest_point.h"
#include "remesh/pipeline/curves.h"
#include "remesh/placement/mesh_curves.h"
#include "remesh/sites/prepared_surface.h"

namespace remesh::detail {

//! A distance that a mesh is to keep from the cleaned input.
struct DistanceBound {
    MeshView input;
    const ClosestPointTree& tree;  //!< Of the input.
    double limit;                  //!< > 0, mesh units.
    //! #E of the cleaned surface: creases, and edges that the distance needs; empty: only creases.
    std::span<const std::uint8_t> hinges = {};
};

//! A surface and the curves on it.
struct CurvedSurface {
    std::unique_ptr<const CurvePlan> plan;
    const Surface* whole;                  //!< The cleaned surface, or the coarse one, uncut.
    const Surface* cleaned;                //!< The cleaned surface.
    double spacing = 0;                    //!< Mesh units: mean distance of the sites.
    const SizeField* sizes = nullptr;      //!< Target lengths; null: all equal.
    const DistanceBound* bound = nullptr;  //!< That the mesh is to keep; null: none.

    //! The surface, cut along the curves.
    [[nodiscard]] const Surface& cut() const { return plan->network.cut.surface(); }
    //! Refers to this surface. Cost: O(#surface).
    [[nodiscard]] MeshCurves curves() const { return {*whole, cut(), plan->network.network}; }
    [[nodiscard]] bool has_junctions() const { return !plan->network.junctions.empty(); }
    [[nodiscard]] bool has_locked() const { return !plan->network.locked.empty(); }
};

//! The same with the base on which propagation runs.
struct Domain : CurvedSurface {
    PreparedSurface prepared;  //!< Of cut().

    //! The surface on which propagation runs.
    [[nodiscard]] const Surface& base() const { return prepared.base.surface(); }
};

//! \param curved  of the input.
//! \throw InvalidInput  a part of the surface is too thin for double precision.
//! Cost: that of PreparedSurface.
[[nodiscard]] Domain prepare_domain(const CleanedInput& cleaned, CurvedSurface curved,
                                    const StageContext& context);

}  // namespace remesh::detail
