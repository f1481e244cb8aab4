//! \file
//! The surface on which sites lie.
#pragma once

#include "remesh/pipeline/curves.h"
#include "remesh/sites/prepared_surface.h"

namespace remesh::detail {

//! The cleaned surface, cut along its curves, and the base on which propagation runs.
struct Domain {
    std::unique_ptr<const CurvePlan> plan;  //!< Null: the surface is not cut.
    PreparedSurface prepared;               //!< Of the surface, cut if there is a plan.
    const Surface* whole;                   //!< The cleaned surface, uncut.
    const Topology* parts;                  //!< Of prepared.input().
    std::vector<Index> component = {};      //!< #F of the base: index into parts->components.
    double spacing = 0;                     //!< Mesh units: mean distance of the sites.
    const SizeField* sizes = nullptr;       //!< Target lengths; null: all equal.

    //! The surface on which propagation runs.
    [[nodiscard]] const Surface& base() const { return prepared.base.surface(); }
    [[nodiscard]] bool has_junctions() const { return plan && !plan->network.junctions.empty(); }
    [[nodiscard]] bool has_locked() const { return plan && !plan->network.locked.empty(); }
};

//! \param cleaned  outlives the domain. Without a plan its surface moves there (see give_back).
//! \throw InvalidInput  a part of the surface is too thin for double precision.
//! Cost: that of PreparedSurface.
[[nodiscard]] Domain prepare_domain(CleanedInput& cleaned, std::unique_ptr<const CurvePlan> plan,
                                    double spacing, const SizeField* sizes,
                                    const StageContext& context);

//! Ends a domain and gives `cleaned` its surface back. Cost: O(#F) if it had moved.
void give_back(Domain domain, CleanedInput& cleaned, int num_threads);

}  // namespace remesh::detail
