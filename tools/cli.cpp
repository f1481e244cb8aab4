// What all programs share. Exceptions of the libraries become texts on stderr and exit codes. The
// first SIGINT or SIGTERM sets a flag, which progress callbacks read; then nothing is written. The
// same callbacks look at the memory in use and draw the progress bar, every few milliseconds.
#include "cli.h"

#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <new>
#include <sstream>
#include <system_error>

#include "remesh/io/atomic_file.h"

namespace cli {

namespace fs = std::filesystem;

const char* const exit_code_help =
    "Exit codes:\n"
    "  0  done (warnings on stderr)          4  the mesh cannot be used\n"
    "  1  internal error, not enough memory  5  a constraint cannot be met, nothing written\n"
    "  2  wrong usage                        130, 143  interrupted, nothing written\n"
    "  3  a file cannot be read or written";

namespace {

// A signal handler can only access a global; lock-free, so that it may write it.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
std::atomic<int> caught_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void on_signal(int number) {
    caught_signal = number;
    ::signal(SIGINT, SIG_DFL);
    ::signal(SIGTERM, SIG_DFL);
}

void catch_signals() {
    // A closed pipe and a file at its size limit are reported as errors of the write instead.
    ::signal(SIGPIPE, SIG_IGN);
    ::signal(SIGXFSZ, SIG_IGN);
    for (const int number : {SIGINT, SIGTERM}) {
        // Signals that the caller ignores (as a shell does for background jobs) stay ignored.
        struct sigaction action {};
        ::sigaction(number, nullptr, &action);
        if (action.sa_handler == SIG_IGN) continue;
        action.sa_handler = on_signal;
        action.sa_flags = 0;  // A blocked read from a pipe returns.
        ::sigaction(number, &action, nullptr);
    }
}

// Parses, and runs the job; help and version end here. Returns the exit code.
ExitCode parse_and_run(CLI::App& app, int argc, const char* const* argv,
                       const std::function<void()>& job) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        std::ostringstream out, err;
        const int code = app.exit(error, out, err);
        print(out.str());
        std::fputs(err.str().c_str(), stderr);
        return code == 0 ? ExitCode::Done : ExitCode::Usage;
    }
    job();
    return ExitCode::Done;
}

}  // namespace

void add_common_options(CLI::App& app, CommonOptions& options) {
    app.add_option("-t,--threads", options.threads, "Number of threads; 0: all cores")
        ->check(CLI::Range(0, 4096))
        ->capture_default_str();
    auto* quiet =
        app.add_flag("-q,--quiet", options.quiet, "Write only warnings and errors to stderr");
    app.add_flag("--verbose", options.verbose, "Write more to stderr")->excludes(quiet);
}

int run(CLI::App& app, int argc, const char* const* argv, const std::function<void()>& job) {
    const std::string name = app.get_name();
    app.set_version_flag("--version", name + " " REMESH_VERSION, "Print the version and exit");
    app.failure_message([&](const CLI::App*, const CLI::Error& error) {
        return name + ": error: " + error.what() + "; see " + name + " --help\n";
    });
    const auto fail = [&](ExitCode code, const std::string& text) {
        std::fprintf(stderr, "%s: error: %s\n", name.c_str(), text.c_str());
        return static_cast<int>(code);
    };
    catch_signals();
    try {
        return static_cast<int>(parse_and_run(app, argc, argv, job));
    } catch (const agvd::InvalidOption& error) {
        return fail(ExitCode::Usage, error.what());
    } catch (const agvd::IoError& error) {
        return fail(ExitCode::File, error.what());
    } catch (const fs::filesystem_error& error) {
        return fail(ExitCode::File, error.what());
    } catch (const agvd::InvalidInput& error) {
        return fail(ExitCode::Mesh, error.what());
    } catch (const agvd::ConstraintUnmet& error) {
        return fail(ExitCode::Constraint, error.what());
    } catch (const agvd::Cancelled&) {
        std::fprintf(stderr, "%s: interrupted, nothing was written\n", name.c_str());
        return 128 + caught_signal;
    } catch (const OutOfMemory& error) {
        return fail(ExitCode::Internal, error.what());
    } catch (const std::bad_alloc&) {
        return fail(ExitCode::Internal, "not enough memory; use a smaller mesh");
    } catch (const std::exception& error) {
        return fail(ExitCode::Internal,
                    std::string("internal error: ") + error.what() +
                        "; please report it with the input and the command line");
    }
}

bool interrupted() { return caught_signal != 0; }

void stop_if_interrupted() {
    if (interrupted()) throw agvd::Cancelled();
}

bool is_same_file(const fs::path& a, const fs::path& b) {
    std::error_code ignored;  // Such as that there is no such file yet.
    if (a == b || fs::equivalent(a, b, ignored)) return true;
    const fs::path real_a = fs::weakly_canonical(fs::absolute(a), ignored);
    const fs::path real_b = fs::weakly_canonical(fs::absolute(b), ignored);
    return !real_a.empty() && real_a == real_b;
}

void check_output(const fs::path& path, std::initializer_list<fs::path> inputs,
                  std::optional<bool> force) {
    for (const fs::path& input : inputs) {
        if (!force.value_or(false) && !input.empty() && is_same_file(path, input)) {
            throw agvd::InvalidOption(path.string() +
                                      " would overwrite an input; choose another file" +
                                      (force ? ", or use --force" : ""));
        }
    }
    remesh::require_writable(path);
}

void print(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() ||
        std::fflush(stdout) != 0) {
        stop_if_interrupted();
        throw agvd::IoError("standard output: cannot be written: " +
                            std::generic_category().message(errno) + "; write to a file");
    }
}

void write_text(const fs::path& path, std::string_view text) {
    if (path == "-") {
        print(text);
    } else {
        remesh::write_file_atomically(path, text, [](double) { return !interrupted(); });
    }
}

void Console::detail(std::string_view text) {
    if (options_.verbose) info(text);
}

void Console::info(std::string_view text) {
    if (options_.quiet) return;
    clear_bar();
    std::fprintf(stderr, "%.*s\n", static_cast<int>(text.size()), text.data());
}

void Console::warn(std::string_view text) {
    clear_bar();
    std::fprintf(stderr, "warning: %.*s\n", static_cast<int>(text.size()), text.data());
}

bool Console::progress(std::string_view stage, double fraction) {
    constexpr std::chrono::milliseconds between_looks{5};
    const auto now = std::chrono::steady_clock::now();
    if (now >= next_look_ || stage != stage_) {
        next_look_ = now + between_looks;
        look(stage, fraction);
    }
    return !is_over_limit_ && !interrupted();
}

agvd::Progress Console::progress_of(const char* stage) {
    return [this, stage](double fraction) { return progress(stage, fraction); };
}

void Console::run(const std::function<void()>& job) {
    try {
        job();
    } catch (const agvd::Cancelled&) {
        if (is_over_limit_ && !interrupted()) throw out_of_memory();
        throw;
    } catch (const std::bad_alloc&) {
        throw out_of_memory();
    }
}

void Console::require_memory(const char* stage, std::size_t bytes) {
    look(stage, 0);
    const std::size_t needed = resident_memory() + bytes;
    if (limit_.bytes == 0 || needed <= limit_.bytes) return;
    is_over_limit_ = true;
    throw out_of_memory("some " + format_bytes(needed) + ", ");
}

OutOfMemory Console::out_of_memory(const std::string& needed) const {
    std::string text = "not enough memory";
    if (is_over_limit_) {
        text += ": the program needs " + needed + "more than the " + format_bytes(limit_.bytes) +
                " of --memory-limit";
    }
    if (!stage_.empty()) text += " (stage: " + stage_ + ")";
    text += "; " + memory_remedy(stage_, limit_.engine);
    return OutOfMemory(is_over_limit_ ? text + ", or raise --memory-limit" : text);
}

// Keeps the name of the stage in which the limit was reached.
void Console::look(std::string_view stage, double fraction) {
    static constexpr std::size_t width = 30;
    if (is_over_limit_) return;
    stage_ = stage;
    is_over_limit_ = limit_.bytes > 0 && resident_memory() > limit_.bytes;
    if (!options_.quiet && ::isatty(STDERR_FILENO) == 1) {
        const auto filled = static_cast<std::size_t>(std::clamp(fraction, 0.0, 1.0) * width);
        std::ostringstream bar;
        bar << '[' << std::string(filled, '#') << std::string(width - filled, ' ') << "] " << stage;
        if (bar.str() != bar_) {
            clear_bar();
            bar_ = bar.str();
            std::fputs(bar_.c_str(), stderr);
        }
    }
}

void Console::clear_bar() {
    if (!bar_.empty()) std::fputs("\r\x1b[K", stderr);
    bar_.clear();
}

}  // namespace cli
