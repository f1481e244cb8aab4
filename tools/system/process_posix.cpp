#include <signal.h>

#include <initializer_list>

#include "system/process.h"

namespace cli {
namespace {

// A signal handler can only access a global.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
void (*do_first)(int) = nullptr;

extern "C" void on_first_signal(int number) {
    do_first(number);
    ::signal(SIGINT, SIG_DFL);
    ::signal(SIGTERM, SIG_DFL);
}

}  // namespace

void begin_process(int&, char**&) {}

void catch_signals(void (*on_signal)(int)) {
    do_first = on_signal;
    // A closed pipe and a file at its size limit are reported as errors of the write instead.
    ::signal(SIGPIPE, SIG_IGN);
    ::signal(SIGXFSZ, SIG_IGN);
    for (const int number : {SIGINT, SIGTERM}) {
        // Signals that the caller ignores (as a shell does for background jobs) stay ignored.
        struct sigaction action {};
        ::sigaction(number, nullptr, &action);
        if (action.sa_handler == SIG_IGN) continue;
        action.sa_handler = on_first_signal;
        action.sa_flags = 0;  // A blocked read from a pipe returns.
        ::sigaction(number, &action, nullptr);
    }
}

}  // namespace cli
