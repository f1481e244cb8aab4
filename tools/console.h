//! \file
//! What a program tells while it runs: log, progress bar; and how it is stopped.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "agvd/core/progress.h"
#include "memory_limit.h"
#include "overall_progress.h"
#include "progress_bar.h"

namespace cli {

struct CommonOptions {
    int threads = 0;  //!< 0: all cores.
    bool quiet = false;
    bool verbose = false;
    ProgressForm progress = ProgressForm::Bar;
};

//! Writes messages to stderr, one on each line, and the progress of the whole run, as a bar on a
//! terminal or as lines of JSON. Also ends the job if it is interrupted or needs too much memory.
class Console {
public:
    explicit Console(const CommonOptions& options, const MemoryLimit& limit = {});
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    //! With --verbose only. So is a line on each stage where it ends: its time, and the most memory
    //! so far.
    void detail(std::string_view text);
    void info(std::string_view text);   //!< Unless --quiet.
    void warn(std::string_view text);   //!< Always.
    void error(std::string_view text);  //!< Always.

    //! The texts of warn(), in their order.
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }
    //! The last stage that was reported; empty: none.
    [[nodiscard]] const std::string& stage() const { return stage_; }

    //! Tells what is still to come, for the bar: see OverallProgress::expect.
    void expect(std::vector<ExpectedStage> stages, Runs runs = Runs::One);

    //! A progress callback: draws the bar, and returns false once interrupted() or above the memory
    //! limit. Cheap: it checks memory and terminal only every few milliseconds.
    [[nodiscard]] bool progress(std::string_view stage, double fraction);
    //! The same for one stage; this must outlive it.
    [[nodiscard]] agvd::Progress progress_of(const char* stage);

    //! Ends the present stage. Otherwise it ends where the next one begins, or the job.
    void end_stage();

    //! Calls the job, whose callbacks are those above.
    //! \throw OutOfMemory  in place of the agvd::Cancelled or std::bad_alloc that this causes.
    void run(const std::function<void()>& job);
    //! Call before work that needs at least this many bytes more.
    //! \throw OutOfMemory  the limit would be exceeded; the text tells how much is needed.
    void require_memory(const char* stage, std::size_t bytes);

private:
    using Clock = std::chrono::steady_clock;

    void look(std::string_view stage, double fraction, Clock::time_point now);
    void begin_stage(std::string_view stage, Clock::time_point now);
    void draw_bar(Clock::time_point now);
    void write_line(const char* kind, std::string_view text);

    const CommonOptions& options_;
    MemoryGuard memory_;
    std::string stage_;  // The last one reported.
    Clock::time_point start_ = Clock::now(), start_of_stage_ = start_;
    Clock::time_point last_expected_ = start_;  // When expect() was called.
    Clock::time_point next_look_, next_draw_;
    std::vector<std::string> warnings_;
    OverallProgress overall_;
    ProgressBar bar_;
};

}  // namespace cli
