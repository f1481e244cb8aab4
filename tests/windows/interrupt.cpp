// interrupt SECONDS COMMAND...: runs a command in a console of its own, and types Ctrl-C there
// after this time. Ends with the exit code of the command.
#include <windows.h>

#include <cstdlib>
#include <cwchar>
#include <string>

int main() {
    // Its own name, the time, and the rest, which is the command.
    std::wstring command = GetCommandLineW();
    const auto next = [&] {
        command.erase(0, command.find(L' ', command[0] == L'"' ? command.find(L'"', 1) : 0));
        command.erase(0, command.find_first_not_of(L' '));
    };
    next();
    const double seconds = std::wcstod(command.c_str(), nullptr);
    next();

    FreeConsole();
    AllocConsole();
    SetConsoleCtrlHandler([](DWORD) -> BOOL { return TRUE; }, TRUE);
    STARTUPINFOW startup{};
    startup.cb = sizeof startup;
    PROCESS_INFORMATION process{};
    if (!CreateProcessW(nullptr, command.data(), nullptr, nullptr, FALSE, 0, nullptr, nullptr,
                        &startup, &process)) {
        return 99;
    }
    Sleep(static_cast<DWORD>(1000 * seconds));
    DWORD code = 98;  // It has ended before.
    if (WaitForSingleObject(process.hProcess, 0) != WAIT_TIMEOUT) return static_cast<int>(code);
    GenerateConsoleCtrlEvent(CTRL_C_EVENT, 0);
    WaitForSingleObject(process.hProcess, INFINITE);
    GetExitCodeProcess(process.hProcess, &code);
    return static_cast<int>(code);
}
