//! \file
//! The runs of all sites, some of which are repeated.
#pragma once

#include <memory>
#include <vector>

#include "agvd/propagation/corners.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/window_front.h"
#include "agvd/update/numbered_sites.h"
#include "agvd/update/site_run.h"

namespace agvd {

//! What the passes of an update of MovingSites read. Sites are known by the numbers of
//! NumberedSites.
struct MovingInput {
    const Surface& surface;
    const Corners& corners;
    const NumberedSites& sites;
    const SitePlacement& placement;  //!< Of the sites, by rank.
    double max_error;
    int num_threads;
};

//! What the repeated runs of one task changed, one site after the other.
struct ChunkChanges {
    struct End {
        Index vertices, faces;
    };
    RunChanges changes;
    std::vector<End> ends;  //!< By site of the task.
};

struct SiteRuns {
    static constexpr Index grain = 4;  //!< Sites that one task propagates.

    std::vector<SiteRun> runs;  //!< By number.
    //! Of the last run_again(), task after task.
    std::vector<ChunkChanges> changes;
    std::vector<std::unique_ptr<WindowFront>> fronts;  //!< Memory for the next ones.
};

//! What the i-th site of the last run_again() changed.
struct SiteChangesView {
    std::span<const RunChanges::Vertex> vertices;
    std::span<const RunChanges::Face> faces;  //!< Their relays are those of the chunk.
    Index chunk;
};
[[nodiscard]] SiteChangesView changes_of(const SiteRuns& runs, Index i);

//! Repeats the runs of some sites with the bounds at hand; sites that own nothing lose theirs.
//! Parallel.
void run_again(const MovingInput& input, std::span<const Index> sites, SiteRuns& runs);

}  // namespace agvd
