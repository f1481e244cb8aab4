//! \file
//! The progress of a call, for JavaScript.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "agvd/core/progress.h"
#include "overall_progress.h"

namespace npm {

//! Tells JavaScript how much of a call is done, some twenty times a second. JavaScript may end it.
class Run {
public:
    //! \param stages  those of the call.
    explicit Run(std::vector<cli::ExpectedStage> stages, cli::Runs runs = cli::Runs::One);

    //! For a stage. This outlives it.
    [[nodiscard]] agvd::Progress of(const char* stage) {
        return [this, stage](double fraction) { return goes_on(stage, fraction); };
    }
    //! \return false if JavaScript wants the call to end.
    [[nodiscard]] bool goes_on(const char* stage, double fraction);

private:
    using Clock = std::chrono::steady_clock;

    cli::OverallProgress overall_;
    std::string stage_;  // The last one.
    Clock::time_point next_call_ = Clock::now();
};

}  // namespace npm
