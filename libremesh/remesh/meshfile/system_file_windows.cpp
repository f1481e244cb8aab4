#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#include <windows.h>

#include "remesh/meshfile/system_file.h"

namespace remesh {

namespace {

constexpr int always = _O_BINARY | _O_NOINHERIT;

}  // namespace

int open_to_read(const std::filesystem::path& path) {
    return ::_wopen(path.c_str(), _O_RDONLY | always);
}

int open_to_write(const std::filesystem::path& path) {
    return ::_wopen(path.c_str(), _O_WRONLY | always);
}

int open_new(const std::filesystem::path& path) {
    return ::_wopen(path.c_str(), _O_WRONLY | _O_CREAT | _O_EXCL | always, _S_IREAD | _S_IWRITE);
}

bool is_writable(const std::filesystem::path& path) {
    constexpr int for_writing = 2;
    return ::_waccess(path.c_str(), for_writing) == 0;
}

// A file inherits them from its folder.
bool take_permissions(int, const std::filesystem::path&) { return true; }

bool wait_to_read(int fd) {
    constexpr DWORD milliseconds = 20;
    const auto file = reinterpret_cast<HANDLE>(::_get_osfhandle(fd));
    DWORD available = 0;
    // To look into a pipe fails at its end.
    if (::GetFileType(file) != FILE_TYPE_PIPE ||
        !::PeekNamedPipe(file, nullptr, 0, nullptr, &available, nullptr) || available > 0) {
        return true;
    }
    ::Sleep(milliseconds);
    return false;
}

}  // namespace remesh
