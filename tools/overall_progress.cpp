#include "overall_progress.h"

#include <algorithm>

namespace cli {

void OverallProgress::expect(std::vector<ExpectedStage> stages, Runs runs) {
    low_ = fraction();
    runs_ = runs;
    high_ = runs == Runs::One ? 1 : (1 + low_) / 2;
    first_share_ = done_before_ = fraction_of_stage_ = 0;
    stage_ = 0;
    stages_ = std::move(stages);
    begin_.assign(1, 0);
    for (const ExpectedStage& stage : stages_) begin_.push_back(begin_.back() + stage.work);
    const double all = begin_.back();
    if (!(all > 0)) return stages_.clear();
    for (double& begin : begin_) begin /= all;
    begin_.back() = 1;
}

void OverallProgress::update(std::string_view stage, double fraction) {
    const auto found = std::find_if(stages_.begin(), stages_.end(),
                                    [&](const ExpectedStage& one) { return one.name == stage; });
    if (found == stages_.end()) return;
    const auto next = static_cast<std::size_t>(found - stages_.begin());
    if (next < stage_) begin_again(next);
    if (next != stage_) fraction_of_stage_ = 0;
    stage_ = next;
    fraction_of_stage_ = std::clamp(fraction, fraction_of_stage_, 1.0);
}

void OverallProgress::begin_again(std::size_t stage) {
    done_before_ += share() - first_share_;
    low_ = fraction();
    if (stages_[stage].begins_run) {
        ++run_;
        high_ = runs_ == Runs::One ? 1 : (1 + low_) / 2;
    }
    first_share_ = begin_[stage];
}

double OverallProgress::share() const {
    if (stages_.empty()) return first_share_;
    return begin_[stage_] + fraction_of_stage_ * (begin_[stage_ + 1] - begin_[stage_]);
}

double OverallProgress::fraction() const {
    if (first_share_ >= 1) return low_;
    return low_ + (high_ - low_) * (share() - first_share_) / (1 - first_share_);
}

std::optional<double> OverallProgress::left_over_done() const {
    constexpr double least = 0.02;  // Before, one stage that is quicker than usual misleads.
    const double done = done_before_ + share() - first_share_;
    if (runs_ == Runs::Unknown || done < least) return std::nullopt;
    return (1 - share()) / done;
}

}  // namespace cli
