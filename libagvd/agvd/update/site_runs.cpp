#include "agvd/update/site_runs.h"

#include <mutex>

#include "agvd/core/parallel.h"
#include "agvd/propagation/window_engine.h"

namespace agvd {

SiteChangesView changes_of(const SiteRuns& runs, Index i) {
    const Index chunk = i / SiteRuns::grain;
    const Index place = i % SiteRuns::grain;
    const auto& [changes, ends] = runs.changes[chunk];
    const ChunkChanges::End begin = place == 0 ? ChunkChanges::End{0, 0} : ends[place - 1];
    const ChunkChanges::End end = ends[place];
    return {std::span(changes.vertices).subspan(begin.vertices, end.vertices - begin.vertices),
            std::span(changes.faces).subspan(begin.faces, end.faces - begin.faces), chunk};
}

void run_again(const MovingInput& input, std::span<const Index> sites, SiteRuns& runs) {
    std::mutex mutex;
    const NumberedSites& numbered = input.sites;
    const auto count = static_cast<Index>(sites.size());
    runs.changes.resize(num_chunks(count, SiteRuns::grain));
    const auto run_chunk = [&](Index chunk, Index begin, Index end) {
        std::unique_ptr<WindowFront> front;
        {
            const std::scoped_lock lock(mutex);
            if (!runs.fronts.empty()) {
                front = std::move(runs.fronts.back());
                runs.fronts.pop_back();
            }
        }
        if (!front) {
            front = std::make_unique<WindowFront>(input.surface, input.corners, input.max_error);
        }
        ChunkChanges& out = runs.changes[chunk];
        out.changes.clear();
        out.ends.clear();
        for (Index i = begin; i < end; ++i) {
            const Index site = sites[i];
            if (numbered.owns_nothing(site)) {
                forget_run(runs.runs[site], out.changes);
            } else {
                front->run(numbered.point(site), numbered.bounds(), default_work_cap);
                replace_run(*front, numbered.is_changed()[site] != 0, runs.runs[site], out.changes);
            }
            out.ends.push_back({static_cast<Index>(out.changes.vertices.size()),
                                static_cast<Index>(out.changes.faces.size())});
        }
        const std::scoped_lock lock(mutex);
        runs.fronts.push_back(std::move(front));
    };
    parallel_chunks(count, SiteRuns::grain, input.num_threads, run_chunk);
}

}  // namespace agvd
