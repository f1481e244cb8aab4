#include <windows.h>

#include "system/same_place.h"

namespace cli {

// The number of an existing file; otherwise its path, where capital letters count as small ones.
std::string place_of(const std::filesystem::path& path) {
    namespace fs = std::filesystem;
    const HANDLE file =
        ::CreateFileW(path.c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                      nullptr, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
    BY_HANDLE_FILE_INFORMATION info{};
    const bool is_known =
        file != INVALID_HANDLE_VALUE && ::GetFileInformationByHandle(file, &info) != 0;
    if (file != INVALID_HANDLE_VALUE) ::CloseHandle(file);
    if (is_known) {
        return std::to_string(info.dwVolumeSerialNumber) + ' ' +
               std::to_string(info.nFileIndexHigh) + ' ' + std::to_string(info.nFileIndexLow);
    }
    std::wstring text = fs::weakly_canonical(fs::absolute(path)).native();
    ::CharLowerBuffW(text.data(), static_cast<DWORD>(text.size()));
    return fs::path(text).string();
}

}  // namespace cli
