// Progress callbacks come about once in a millisecond. Every few of them look at the memory in use,
// fewer still draw the bar.
#include "console.h"

#include <cstdio>
#include <new>

#include "cli.h"

namespace cli {
namespace {

constexpr std::chrono::milliseconds between_looks{5}, between_drawings{50};
// Before, the time left would be guessed from little.
constexpr std::chrono::seconds before_time_left{1};

std::string seconds_text(std::chrono::steady_clock::duration time) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f s", std::chrono::duration<double>(time).count());
    return text;
}

}  // namespace

Console::Console(const CommonOptions& options, const MemoryLimit& limit)
    : options_(options), memory_(limit), bar_(!options.quiet, options.progress) {}

void Console::detail(std::string_view text) {
    if (options_.verbose) info(text);
}

void Console::info(std::string_view text) {
    if (!options_.quiet) write_line("", text);
}

void Console::warn(std::string_view text) {
    write_line("warning: ", text);
    warnings_.emplace_back(text);
}

void Console::error(std::string_view text) { write_line("error: ", text); }

void Console::write_line(const char* kind, std::string_view text) {
    bar_.clear();
    std::fprintf(stderr, "%s%.*s\n", kind, static_cast<int>(text.size()), text.data());
}

void Console::expect(std::vector<ExpectedStage> stages, Runs runs) {
    overall_.expect(std::move(stages), runs);
    last_expected_ = Clock::now();
}

bool Console::progress(std::string_view stage, double fraction) {
    const auto now = Clock::now();
    if (now >= next_look_ || stage != stage_) {
        next_look_ = now + between_looks;
        look(stage, fraction, now);
    }
    return !memory_.is_over() && !interrupted();
}

agvd::Progress Console::progress_of(const char* stage) {
    return [this, stage](double fraction) { return progress(stage, fraction); };
}

void Console::run(const std::function<void()>& job) {
    try {
        job();
        end_stage();
    } catch (const agvd::Cancelled&) {
        if (memory_.is_over() && !interrupted()) throw memory_.error(stage_);
        throw;
    } catch (const std::bad_alloc&) {
        throw memory_.error(stage_);
    }
}

void Console::end_stage() { begin_stage("", Clock::now()); }

void Console::require_memory(const char* stage, std::size_t bytes) {
    try {
        memory_.require(stage, bytes);
    } catch (const OutOfMemory&) {
        stage_ = stage;
        throw;
    }
}

// Keeps the name of the stage in which the limit was reached.
void Console::look(std::string_view stage, double fraction, Clock::time_point now) {
    if (memory_.is_over()) return;
    if (stage != stage_) begin_stage(stage, now);
    static_cast<void>(memory_.check());
    overall_.update(stage, fraction);
    if (now >= next_draw_) draw_bar(now);
}

// Tells of the stage before.
void Console::begin_stage(std::string_view stage, Clock::time_point now) {
    if (!stage_.empty()) {
        detail(stage_ + ": " + seconds_text(now - start_of_stage_) + ", memory peak " +
               format_bytes(peak_memory()));
    }
    stage_ = stage;
    start_of_stage_ = now;
}

void Console::draw_bar(Clock::time_point now) {
    if (!bar_.is_shown()) return;
    next_draw_ = now + between_drawings;
    using std::chrono::seconds;
    const auto elapsed = std::chrono::duration_cast<seconds>(now - start_);
    ProgressState state{overall_.fraction(), stage_, overall_.run(), elapsed, {}};
    const std::optional<double> left_over_done = overall_.left_over_done();
    if (left_over_done && now - start_ >= before_time_left) {
        const std::chrono::duration<double> spent = now - last_expected_;
        state.left = std::chrono::ceil<seconds>(spent * *left_over_done);
    }
    bar_.draw(state);
}

}  // namespace cli
