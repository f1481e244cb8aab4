//! \file
//! What files need of the operating system. The descriptors are those of POSIX, whose read(),
//! write(), close() and fstat() Windows has as well. Private.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace remesh {

//! The path that a text in UTF-8 names. Windows would read a std::string in another encoding; the
//! string() of a path is in UTF-8 there, too.
[[nodiscard]] inline std::filesystem::path path_of(std::string_view text) {
    return std::u8string(text.begin(), text.end());
}

//! Opens a file for reading, a pipe without waiting for its other end. -1: see errno.
[[nodiscard]] int open_to_read(const std::filesystem::path& path);

//! Opens a file that exists for writing. -1: see errno.
[[nodiscard]] int open_to_write(const std::filesystem::path& path);

//! Makes a file, which must not exist, for writing. -1: see errno.
[[nodiscard]] int open_new(const std::filesystem::path& path);

//! Whether a file may be written; otherwise see errno.
[[nodiscard]] bool is_writable(const std::filesystem::path& path);

//! Gives the new file the owner, if the system allows it, and the permissions of an old one.
//! \return false: it cannot have the permissions, see errno.
[[nodiscard]] bool take_permissions(int fd, const std::filesystem::path& old);

//! Waits some milliseconds until there is something to read, or the end; a file is always ready.
[[nodiscard]] bool wait_to_read(int fd);

}  // namespace remesh
