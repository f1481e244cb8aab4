//! \file
//! What every stage gets in addition to its data: options, result, clock and progress.
#pragma once

#include <chrono>

#include "remesh/pipeline/remesh.h"

namespace remesh::detail {

//! Refers to values that the caller of the stage owns.
struct StageContext {
    const RemeshOptions& options;  //!< Checked.
    RemeshResult& result;          //!< The stage adds its counts and times.
};

//! The fraction of Stage::Clean at which cleaning itself is done, and the surface is prepared.
inline constexpr double cleaned_fraction = 0.1;

//! Adds the time from construction to destruction to a stage of the result.
class StageClock {
public:
    StageClock(Stage stage, RemeshResult& result)
        : stage_(stage), result_(result), start_(std::chrono::steady_clock::now()) {}
    StageClock(const StageClock&) = delete;
    StageClock& operator=(const StageClock&) = delete;
    ~StageClock() {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
        for (auto& [stage, seconds] : result_.seconds) {
            if (stage == stage_) seconds += spent.count();
        }
    }

private:
    Stage stage_;
    RemeshResult& result_;
    std::chrono::steady_clock::time_point start_;
};

//! Whether relaxation moves the sites; only then are vertices placed by default.
[[nodiscard]] inline bool is_relaxed(const RemeshOptions& options) {
    return options.relax_steps > 0 && !(options.sites && options.keep_sites);
}

//! The caller's callback, bound to one stage; empty if there is none.
[[nodiscard]] inline Progress progress_of(Stage stage, const RemeshOptions& options) {
    if (!options.progress) return {};
    return [&options, stage](double fraction) { return options.progress(stage, fraction); };
}

//! The same, but it always gets this fraction.
[[nodiscard]] inline Progress progress_at(Stage stage, const RemeshOptions& options,
                                          double fraction) {
    if (!options.progress) return {};
    return [&options, stage, fraction](double) { return options.progress(stage, fraction); };
}

//! Of what follows cleaning and comes before the surface is prepared.
[[nodiscard]] inline Progress cleaned_progress(const RemeshOptions& options) {
    return progress_at(Stage::Clean, options, cleaned_fraction);
}

}  // namespace remesh::detail
