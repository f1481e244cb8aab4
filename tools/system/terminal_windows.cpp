#include <io.h>
#include <windows.h>

#include "system/terminal.h"

namespace cli {

std::size_t terminal_width(int file) {
    CONSOLE_SCREEN_BUFFER_INFO info{};
    const auto handle = reinterpret_cast<HANDLE>(::_get_osfhandle(file));
    if (!::GetConsoleScreenBufferInfo(handle, &info)) return 0;
    return static_cast<std::size_t>(info.srWindow.Right - info.srWindow.Left + 1);
}

}  // namespace cli
