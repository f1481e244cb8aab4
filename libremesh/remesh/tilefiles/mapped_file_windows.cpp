#include <windows.h>

#include <cerrno>

#include "remesh/tilefiles/mapped_file.h"

namespace remesh {

int MappedFile::map(const std::filesystem::path& path) {
    const HANDLE file = ::CreateFileW(path.c_str(), GENERIC_READ, FILE_SHARE_READ, nullptr,
                                      OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (file == INVALID_HANDLE_VALUE) {
        return ::GetLastError() == ERROR_ACCESS_DENIED ? EACCES : ENOENT;
    }
    LARGE_INTEGER size{};
    ::GetFileSizeEx(file, &size);
    size_ = static_cast<std::size_t>(size.QuadPart);
    // No mapping is made of an empty file.
    const HANDLE mapping = ::CreateFileMappingW(file, nullptr, PAGE_READONLY, 0, 0, nullptr);
    if (mapping != nullptr) data_ = ::MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, 0);
    if (mapping != nullptr) ::CloseHandle(mapping);
    ::CloseHandle(file);
    return size_ > 0 ? ENOMEM : 0;
}

MappedFile::~MappedFile() { ::UnmapViewOfFile(data_); }

}  // namespace remesh
