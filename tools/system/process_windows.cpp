#include <fcntl.h>
#include <io.h>
#include <signal.h>
#include <windows.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "system/process.h"

// Of the C library. NOLINTNEXTLINE
extern "C" int __wgetmainargs(int*, wchar_t***, wchar_t***, int expands_wildcards, int* new_mode);

namespace cli {
namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
std::atomic<void (*)(int)> do_first = nullptr;

// Runs on a thread of its own. FALSE: Windows ends the process.
BOOL WINAPI on_control(DWORD event) {
    auto* const on_signal = do_first.exchange(nullptr);
    if (on_signal == nullptr || (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT)) return FALSE;
    on_signal(SIGINT);
    return TRUE;
}

}  // namespace

void begin_process(int& argc, char**& argv) {
    for (const int stream : {0, 1, 2}) ::_setmode(stream, _O_BINARY);
    static const UINT encoding = ::GetConsoleOutputCP();
    ::SetConsoleOutputCP(CP_UTF8);
    std::atexit([] { ::SetConsoleOutputCP(encoding); });
    // So that a console knows the escape sequences of the progress bar.
    const HANDLE console = ::GetStdHandle(STD_ERROR_HANDLE);
    DWORD mode = 0;
    if (::GetConsoleMode(console, &mode)) {
        ::SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
    }

    wchar_t **wide = nullptr, **environment = nullptr;
    int new_mode = 0;
    ::__wgetmainargs(&argc, &wide, &environment, 1, &new_mode);
    static std::vector<std::string> texts;
    static std::vector<char*> arguments;
    for (int i = 0; i < argc; ++i) texts.push_back(std::filesystem::path(wide[i]).string());
    for (std::string& text : texts) arguments.push_back(text.data());
    arguments.push_back(nullptr);
    argv = arguments.data();
}

void catch_signals(void (*on_signal)(int)) {
    do_first = on_signal;
    ::SetConsoleCtrlHandler(on_control, TRUE);
}

}  // namespace cli
