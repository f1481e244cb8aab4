//! \file
//! Code that all programs share: exit codes, interruption, checks of output paths.
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "agvd/core/error.h"
#include "console.h"

namespace CLI {
class App;
}

namespace cli {

//! Also 130 after SIGINT and 143 after SIGTERM; then nothing was written, but for the meshes of a
//! batch that were finished before.
enum class ExitCode {
    Done = 0,
    Internal = 1,    //!< Our bug, or not enough memory: see OutOfMemory.
    Usage = 2,       //!< Command line, agvd::InvalidOption.
    File = 3,        //!< agvd::IoError.
    Mesh = 4,        //!< agvd::InvalidInput.
    Constraint = 5,  //!< agvd::ConstraintUnmet; nothing written.
    Batch = 6,       //!< Some meshes of a batch failed; the others are written.
};

//! The exit codes as text for the end of --help.
extern const char* const exit_code_help;

//! Adds -t/--threads, -q/--quiet, --verbose and --progress; they are valid once run() calls the
//! job.
void add_common_options(CLI::App& app, CommonOptions& options);

//! Why a job ended without a result.
struct Failure {
    int exit_code = 0;
    std::string text;
};

//! A job has done only a part of its work.
class PartlyDone : public agvd::Error {
public:
    explicit PartlyDone(const Failure& failure)
        : Error(failure.text), exit_code_(failure.exit_code) {}
    [[nodiscard]] int exit_code() const { return exit_code_; }

private:
    int exit_code_;
};

//! The exit code and the text for what a job has thrown.
[[nodiscard]] Failure failure_of(const std::exception_ptr& thrown);

//! main() of every program: parses the command line (adding --version), runs the job, and turns
//! what either throws into a text on stderr and an exit code. While the job runs, the first SIGINT
//! or SIGTERM makes interrupted() true; a second one kills the program at once.
[[nodiscard]] int run(CLI::App& app, int argc, const char* const* argv,
                      const std::function<void()>& job);

//! True once SIGINT or SIGTERM has come.
[[nodiscard]] bool interrupted();

//! The exit code once interrupted().
[[nodiscard]] int interruption_code();

//! Call before writing.
//! \throw agvd::Cancelled if interrupted().
void stop_if_interrupted();

//! Whether both name one file, which need not exist yet.
[[nodiscard]] bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

//! Checks an output path before the long work.
//! \param inputs  files that must not be overwritten without `force`; may be empty paths.
//! \param force   value of --force; unset: the program has no such option.
//! \throw agvd::InvalidOption  the path is one of the inputs (also through links).
//! \throw agvd::IoError        it cannot be written (remesh::require_writable).
void check_output(const std::filesystem::path& path,
                  std::initializer_list<std::filesystem::path> inputs,
                  std::optional<bool> force = {});

//! For --no-clobber.
//! \throw agvd::IoError  there is such a file. Devices and pipes do not count: they are not
//!        replaced.
void require_new(const std::filesystem::path& path);

//! Returns what `work` returns; an error of the mesh, of given sites or of a constraint that it
//! throws gets the file's name in front.
//! \param sites  the file of the given sites, if there is one.
template <typename Work>
auto naming_file(const std::filesystem::path& path, const Work& work,
                 const std::filesystem::path& sites = {}) {
    try {
        return work();
    } catch (const agvd::InvalidSites& error) {
        throw agvd::InvalidSites((sites.empty() ? path : sites).string() + ": " + error.what());
    } catch (const agvd::InvalidInput& error) {
        throw agvd::InvalidInput(path.string() + ": " + error.what());
    } catch (const agvd::ConstraintUnmet& error) {
        throw agvd::ConstraintUnmet(path.string() + ": " + error.what());
    }
}

//! Writes to stdout and flushes.
//! \throw agvd::IoError if that fails.
void print(std::string_view text);

//! Writes a text to `path`, all or nothing, or to stdout if the path is "-".
//! \throw agvd::Cancelled  if interrupted(): an old file is unchanged.
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace cli
