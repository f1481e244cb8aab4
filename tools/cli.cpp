// What all programs share. Exceptions of the libraries become texts on stderr and exit codes. The
// first SIGINT or SIGTERM sets a flag, which progress callbacks read; then nothing is written.
#include "cli.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <new>
#include <sstream>
#include <system_error>

#include "help.h"
#include "nearest_name.h"
#include "option_names.h"
#include "remesh/meshfile/atomic_file.h"
#include "system/process.h"

namespace cli {

namespace fs = std::filesystem;

const char* const exit_code_help =
    "Exit codes:\n"
    "  0  done; warnings are on stderr\n"
    "  1  internal error, or not enough memory\n"
    "  2  wrong usage\n"
    "  3  a file cannot be read or written\n"
    "  4  the mesh cannot be used\n"
    "  5  a constraint cannot be met, nothing written\n"
    "  130, 143  interrupted, nothing written";

namespace {

// A signal handler can only access a global; lock-free, so that it may write it.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
std::atomic<int> caught_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

// What is wrong with a command line; options of subcommands in use count as well.
std::string usage_error(const CLI::App& app, const CLI::Error& error) {
    const std::vector<std::string> extra = app.remaining(true);
    const auto unknown = std::find_if(
        extra.begin(), extra.end(), [](const std::string& text) { return text.starts_with('-'); });
    const bool is_unknown = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
    if (!is_unknown || unknown == extra.end()) return error.what();
    std::vector<std::string> names;
    const auto add_names = [&names](const CLI::App& of) {
        for (const CLI::Option* option : of.get_options()) {
            for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        }
    };
    add_names(app);
    for (const CLI::App* used : app.get_subcommands()) add_names(*used);
    const std::string name = unknown->substr(0, unknown->find('='));
    const std::string nearest = nearest_name(name, names);
    return "there is no option " + name +
           (nearest.empty() ? "" : " (did you mean " + nearest + "?)");
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
    start_group(app, heading::running);
    app.add_option("-t,--threads", options.threads, "Number of threads; 0: all cores")
        ->check(CLI::Range(0, 4096).description(""))
        ->type_name("N")
        ->capture_default_str();
    auto* quiet =
        app.add_flag("-q,--quiet", options.quiet, "Write only warnings and errors to stderr");
    app.add_flag("--verbose", options.verbose,
                 "Also write to stderr what each stage did, its time and the memory")
        ->excludes(quiet);
    app.add_option_function<std::string>(
           "--progress",
           [&options](const std::string& form) {
               options.progress = form == "json" ? ProgressForm::Json : ProgressForm::Bar;
           },
           "How stderr shows progress. bar: on a terminal only, and not with --quiet; json: for "
           "other programs, as lines {\"progress\": 0.42, \"stage\": \"relax\", \"run\": 1}, at "
           "most twenty a second; progress goes from 0 to 1 and never falls")
        ->check(CLI::IsMember({"bar", "json"}).description(""))
        ->type_name("bar|json")
        ->default_str("bar");
}

Failure failure_of(const std::exception_ptr& thrown) {
    const auto failure = [](ExitCode code, const std::string& text) {
        return Failure{static_cast<int>(code), with_option_names(text)};
    };
    try {
        std::rethrow_exception(thrown);
    } catch (const agvd::InvalidOption& error) {
        return failure(ExitCode::Usage, error.what());
    } catch (const agvd::IoError& error) {
        return failure(ExitCode::File, error.what());
    } catch (const fs::filesystem_error& error) {
        return failure(ExitCode::File, error.what());
    } catch (const agvd::InvalidInput& error) {
        return failure(ExitCode::Mesh, error.what());
    } catch (const agvd::ConstraintUnmet& error) {
        return failure(ExitCode::Constraint, error.what());
    } catch (const PartlyDone& error) {
        return {error.exit_code(), error.what()};
    } catch (const agvd::Cancelled&) {
        return {interruption_code(), "interrupted, nothing was written"};
    } catch (const OutOfMemory& error) {
        return failure(ExitCode::Internal, error.what());
    } catch (const std::bad_alloc&) {
        return failure(ExitCode::Internal, "not enough memory; use a smaller mesh");
    } catch (const std::exception& error) {
        return failure(ExitCode::Internal,
                       std::string("internal error: ") + error.what() +
                           "; please report it with the input and the command line");
    }
}

int run(CLI::App& app, int argc, const char* const* argv, const std::function<void()>& job) {
    const std::string name = app.get_name();
    start_group(app, heading::running);
    app.set_version_flag("--version", name + " " REMESH_VERSION, "Print the version and exit");
    format_help(app);
    // On Windows /path would be an option.
    app.allow_windows_style_options(false);
    for (CLI::App* command : app.get_subcommands({})) command->allow_windows_style_options(false);
    app.failure_message([&](const CLI::App* failed, const CLI::Error& error) {
        return name + ": error: " + usage_error(*failed, error) + "; see " + name + " --help\n";
    });
    catch_signals([](int number) { caught_signal = number; });
    try {
        return static_cast<int>(parse_and_run(app, argc, argv, job));
    } catch (...) {
        const auto [code, text] = failure_of(std::current_exception());
        const char* const kind = interrupted() && code == interruption_code() ? "" : "error: ";
        std::fprintf(stderr, "%s: %s%s\n", name.c_str(), kind, text.c_str());
        return code;
    }
}

bool interrupted() { return caught_signal != 0; }

int interruption_code() { return 128 + caught_signal; }

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

void require_new(const fs::path& path) {
    if (!fs::is_regular_file(path)) return;
    throw agvd::IoError(path.string() +
                        ": exists already; choose another file, or leave out --no-clobber");
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

}  // namespace cli
