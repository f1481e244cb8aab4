#include <sys/ioctl.h>
#include <unistd.h>

#include "system/terminal.h"

namespace cli {

std::size_t terminal_width(int file) {
    winsize size{};
    if (::isatty(file) != 1 || ::ioctl(file, TIOCGWINSZ, &size) != 0) return 0;
    return size.ws_col;
}

}  // namespace cli
