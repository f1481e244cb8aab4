//! \file
//! Reads edges that the user named.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh {

//! A text file with two vertices per line, counted from 0 as in the arrays of read_mesh's result;
//! what follows # is a comment.
//!
//! \throw IoError  the file cannot be read, a line has another form, or there is no edge; the
//!        text names the file, the line and the remedy.
//! \throw InvalidInput  a number is beyond 64 bits.
//! Cost: O(file size).
[[nodiscard]] std::vector<std::array<Index, 2>> read_edges(const std::filesystem::path& path,
                                                           const Progress& progress = {});

}  // namespace remesh
