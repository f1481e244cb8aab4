#include "support/process.h"

#include <fcntl.h>
#include <pty.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace process {
namespace {

// Starts the program with stdout in a file and stderr in the pipe; signals as in a terminal, even
// if this process was started with them ignored.
pid_t start(const std::vector<std::string>& command, const std::filesystem::path& out,
            const std::array<int, 2>& pipe) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, pipe[1], STDERR_FILENO);
    posix_spawn_file_actions_addclose(&actions, pipe[0]);
    posix_spawn_file_actions_addclose(&actions, pipe[1]);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t defaults;
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGINT);
    sigaddset(&defaults, SIGTERM);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    pid_t pid = 0;
    const int failure =
        posix_spawn(&pid, arguments[0], &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) throw std::runtime_error("cannot start " + command[0]);
    return pid;
}

// The ends to read from and to write to.
std::array<int, 2> make_pipe(unsigned short columns) {
    std::array<int, 2> ends{};
    winsize size{};
    size.ws_row = 25;
    size.ws_col = columns;
    const int failure =
        columns == 0 ? ::pipe(ends.data()) : ::openpty(&ends[0], &ends[1], nullptr, nullptr, &size);
    if (failure != 0) throw std::runtime_error("no pipe or terminal left");
    return ends;
}

}  // namespace

Outcome run(const std::vector<std::string>& command, const Options& options) {
    std::string temporary = std::filesystem::temp_directory_path() / "stdout-XXXXXX";
    const int file = mkstemp(temporary.data());
    if (file < 0) throw std::runtime_error("no file left");
    close(file);
    const std::array<int, 2> pipe = make_pipe(options.columns);
    const pid_t pid =
        start(command, options.out.empty() ? std::filesystem::path(temporary) : options.out, pipe);
    close(pipe[1]);

    Outcome outcome;
    bool signalled = options.signal == 0;
    std::array<char, 4096> buffer;
    for (ssize_t n = 0; (n = read(pipe[0], buffer.data(), buffer.size())) > 0;) {
        outcome.err.append(buffer.data(), static_cast<std::size_t>(n));
        if (!signalled && outcome.err.find(options.after) != std::string::npos) {
            kill(pid, options.signal);
            signalled = true;
        }
    }
    close(pipe[0]);
    int status = 0;
    rusage usage{};
    wait4(pid, &status, 0, &usage);
    outcome.peak_bytes = static_cast<std::size_t>(usage.ru_maxrss) * 1024;
    outcome.killed = WIFSIGNALED(status);
    outcome.exit_code = outcome.killed ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    std::ostringstream text;
    text << std::ifstream(temporary).rdbuf();
    outcome.out = text.str();
    std::filesystem::remove(temporary);
    return outcome;
}

}  // namespace process
