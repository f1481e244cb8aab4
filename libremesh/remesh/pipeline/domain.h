//! \file
//! The surface on which sites lie.
#pragma once

#include "remesh/pipeline/curves.h"
#include "remesh/sites/prepared_surface.h"

namespace remesh::detail {

//! The cleaned surface, cut along its curves, and the base on which propagation runs.
struct Domain {
    std::unique_ptr<const CurvePlan> plan;
    PreparedSurface prepared;          //!< Of the surface, cut along the plan's curves.
    const Surface* whole;              //!< The cleaned surface, or the coarse one, uncut.
    const Surface* cleaned;            //!< The cleaned surface.
    std::vector<Index> patch = {};     //!< #F of the base: index into plan->patches.components.
    double spacing = 0;                //!< Mesh units: mean distance of the sites.
    const SizeField* sizes = nullptr;  //!< Target lengths; null: all equal.

    //! The surface on which propagation runs.
    [[nodiscard]] const Surface& base() const { return prepared.base.surface(); }
    [[nodiscard]] bool has_junctions() const { return !plan->network.junctions.empty(); }
    [[nodiscard]] bool has_locked() const { return !plan->network.locked.empty(); }
};

//! \param cleaned  outlives the domain.
//! \throw InvalidInput  a part of the surface is too thin for double precision.
//! Cost: that of PreparedSurface.
[[nodiscard]] Domain prepare_domain(const CleanedInput& cleaned,
                                    std::unique_ptr<const CurvePlan> plan, double spacing,
                                    const SizeField* sizes, const StageContext& context);

}  // namespace remesh::detail
