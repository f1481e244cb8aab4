//! \file
//! All or nothing: a file appears whole under its name, or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace remesh {

//! Writes `bytes` to a temporary file in the target's folder and renames it over the target. On
//! failure, or when an exception or signal handler unwinds, the temporary is removed and an old
//! target stays as it was.
//! \throw agvd::IoError  naming the path and the system's reason.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace remesh
