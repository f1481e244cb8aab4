//! \file
//! How much of a whole run is done, from what its stages tell.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

//! A stage still to come.
struct ExpectedStage {
    std::string name;
    double work = 0;          //!< >= 0, in any unit: its time against that of the others.
    bool begins_run = false;  //!< Whether a run that is repeated begins here.
};

//! Whether it is known how many runs are needed.
enum class Runs { One, Unknown };

//! Shares of the work that stages are expected to take make one fraction of the whole. Where stages
//! come again, they share what is left of it, so that it never falls.
class OverallProgress {
public:
    //! What is still to come, in its order; takes the place of what was told before. What is done
    //! by then counts as the fraction that it has reached.
    //! \param runs  Unknown: each run takes half of what the runs before it have left.
    void expect(std::vector<ExpectedStage> stages, Runs runs = Runs::One);

    //! A stage that is not expected changes nothing.
    //! \param fraction  of this stage, in [0, 1].
    void update(std::string_view stage, double fraction);

    //! Of the whole, in [0, 1]; never falls.
    [[nodiscard]] double fraction() const;
    //! Counts from 1.
    [[nodiscard]] int run() const { return run_; }
    //! What is left of the work over what was done since expect(), if no further stage is repeated.
    //! Unset: it is not known, or too little is done.
    [[nodiscard]] std::optional<double> left_over_done() const;

private:
    // Of the expected work, what is done at this fraction of the present stage.
    [[nodiscard]] double share() const;
    void begin_again(std::size_t stage);

    std::vector<ExpectedStage> stages_;
    std::vector<double> begin_;  // Of each stage: the share of the work before it; 1 at the end.
    Runs runs_ = Runs::One;
    std::size_t stage_ = 0;  // The present one.
    double fraction_of_stage_ = 0;
    // From first_share_ to all of the work the fraction of the whole goes from low_ to high_.
    double first_share_ = 0, low_ = 0, high_ = 0;
    double done_before_ = 0;  // Work, in shares, of stages that were repeated.
    int run_ = 1;
};

}  // namespace cli
