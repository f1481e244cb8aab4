//! \file
//! The paths that name streams of the process. Private to the readers and writers.
#pragma once

#include <unistd.h>

#include <filesystem>

#include "remesh/names.h"

namespace remesh {

// These are used through their descriptors: to open them again would fail for sockets, and would
// replace a file instead of writing to where the caller's shell has got to.

[[nodiscard]] inline bool is_standard_input(const std::filesystem::path& path) {
    return path == "/dev/stdin";
}
[[nodiscard]] inline bool is_standard_output(const std::filesystem::path& path) {
    return path == "/dev/stdout";
}

}  // namespace remesh
