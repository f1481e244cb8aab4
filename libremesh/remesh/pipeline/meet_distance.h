//! \file
//! Results near to the cleaned surface: how far they lie from it, and runs with shorter and shorter
//! edges until one is near enough.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "agvd/mesh/closest_point.h"
#include "remesh/curves/select_creases.h"
#include "remesh/pipeline/cleaned_input.h"
#include "remesh/pipeline/domain.h"

namespace remesh::detail {

//! The distance of a result.
struct MeasuredDistance {
    double largest = 0;         //!< Both ways, at the points looked at; mesh units.
    bool is_within = false;     //!< Proved: no point of either surface is too far.
    Vec3 where = Vec3::Zero();  //!< A point of either surface that is so far.
    //! On the input, where edges have to be shorter, with their length.
    std::vector<SizedPoint> lengths = {};
};

//! Measures at all vertices and at 100 000 points of each surface. If these are near enough, faces
//! are divided until all of both surfaces is proved to be, or a point is found that is not.
//! \param targets  #V of the result: lengths that its edges were to have; empty: unknown.
//! \param limit    where a point is near it or beyond, edges have to be shorter.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O((n + 100 000) log n); for the proof about O((n + length of all edges / limit) log n).
[[nodiscard]] MeasuredDistance measure_distance(const MeshView& input,
                                                const ClosestPointTree& input_tree,
                                                const MeshView& result,
                                                std::span<const double> targets, double limit,
                                                int num_threads = 1, const Progress& progress = {});

//! A whole run after cleaning.
//! \param lengths  on the cleaned surface: how long edges are at most.
//! \param bound    see run_attempt.
using RunWithLengths = std::function<RemeshResult(
    const RemeshOptions& options, std::span<const SizedPoint> lengths, const DistanceBound* bound)>;

//! A run with the lengths that curvature asks for, which keeps the distance by changes in places
//! (bring_near). If it does not, further runs with shorter edges where the result is too far.
//! Vertices that the topology needs are added (VertexCount::Add).
//! \param cleaned  as before after each run.
//! \param limit    > 0, mesh units: of MaxDistance.
//! \throw ConstraintUnmet  it was not met in the rounds made; the text gives the best.
//! Cost: mostly that of one run with bring_near; that of measure_distance and of a run in each
//! further one of up to 16 rounds.
[[nodiscard]] RemeshResult meet_distance(const CleanedInput& cleaned, const RemeshOptions& options,
                                         double limit, const RunWithLengths& run);

}  // namespace remesh::detail
