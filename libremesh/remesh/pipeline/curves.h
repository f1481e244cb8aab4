//! \file
//! The curves that the result reproduces in addition to the boundary: creases and junctions.
#pragma once

#include <memory>
#include <optional>

#include "agvd/mesh/topology.h"
#include "remesh/curves/select_creases.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/sites/network_plan.h"

namespace remesh::detail {

struct CleanedInput;
struct StageContext;

//! Creases, seams and junctions of the cleaned surface.
struct FoundCurves {
    std::vector<std::uint8_t> is_crease;  //!< #E; empty: no creases are wanted.
    std::vector<std::uint8_t> is_given;   //!< #E: of these the caller's own, or borders of labels.
    //! #E: creases beside these which select_creases() left out; empty: it did not choose.
    std::vector<std::uint8_t> is_close;
    std::vector<SizedPoint> strips;  //!< Between creases that are closer than the sites.
    //! #E: texture seams; empty: there are none. Those of `is_wide` can be curves at the spacing.
    std::vector<std::uint8_t> is_seam, is_wide;
    JunctionSet junctions;
};

//! What becomes of creases that are closer than sites can be (select_creases).
enum class CloseCreases {
    Stay,
    Go,
    GoOrRefine  //!< They stay where shorter edges between them are worth it.
};

//! Which of these curves a mesh reproduces.
struct KeptCurves {
    bool has_junctions = true;
    bool has_seams = true;
    std::vector<std::uint8_t> is_crease = {};  //!< #E: some of those found; empty: none.
};

//! A network of curves and the surface cut along it.
struct CurvePlan {
    NetworkPlan network;
    std::optional<GivenSites> given;  //!< Only with the caller's sites.
};

//! All creases, and junctions. Seams follow by choose_curves.
//! \param spacing  of the sites, mesh units.
//! Cost: O(#E) for each length at which creases are sought.
[[nodiscard]] FoundCurves find_curves(const CleanedInput& cleaned, double spacing,
                                      const StageContext& context);

//! Whether choose_curves() may leave out creases: otherwise lengths do not matter to it.
[[nodiscard]] bool may_leave_out(const FoundCurves& found, CloseCreases close,
                                 const RemeshOptions& options);

//! Leaves out creases that are too close to others, and finds seams.
//! \param sizes  null: all edges are as long as the spacing.
//! \param found  of find_curves().
//! Cost: that of select_creases.
void choose_curves(const CleanedInput& cleaned, double spacing, CloseCreases close,
                   const SizeField* sizes, const StageContext& context, FoundCurves& found);

//! Creases of the surface by its shape alone (see remesh::find_creases).
//! \return #E; empty with Features::Off. Cost: that of find_creases.
[[nodiscard]] std::vector<std::uint8_t> find_own_creases(const CleanedInput& cleaned,
                                                         double spacing,
                                                         const RemeshOptions& options);

//! \param sizes  target lengths; null: all equal.
//! \return see plan_network; without a cut if the sites are too few.
//! Cost: see plan_network and plan_given_network.
[[nodiscard]] std::unique_ptr<const CurvePlan> plan_curves(const CleanedInput& cleaned,
                                                           const FoundCurves& found,
                                                           const KeptCurves& kept, double spacing,
                                                           const SizeField* sizes,
                                                           const StageContext& context);

}  // namespace remesh::detail
