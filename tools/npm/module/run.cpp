#include "run.h"

#include <utility>

//! Of the engine: tells the caller. \return 0: the call is to end.
extern "C" __attribute__((import_module("env"), import_name("progress"))) int remesh_progress(
    const char* stage, std::size_t length, double fraction);

namespace npm {
namespace {

constexpr std::chrono::milliseconds between_calls{50};

}  // namespace

Run::Run(std::vector<cli::ExpectedStage> stages, cli::Runs runs) {
    overall_.expect(std::move(stages), runs);
}

bool Run::goes_on(const char* stage, double fraction) {
    const auto now = Clock::now();
    const bool is_new = stage != stage_;
    if (!is_new && now < next_call_) return true;
    next_call_ = now + between_calls;
    stage_ = stage;
    overall_.update(stage, fraction);
    return remesh_progress(stage_.data(), stage_.size(), overall_.fraction()) != 0;
}

}  // namespace npm
