//! \file
//! Medit's .sol files: values of vertices. Private to the programs.
#pragma once

#include <filesystem>
#include <vector>

#include "agvd/core/progress.h"
#include "remesh/names.h"

namespace remesh {

//! Whether the name ends in .sol (any case), or in .sol.gz.
[[nodiscard]] bool is_solution_file(const std::filesystem::path& path);

//! The lengths in a file (ascii), one for each vertex, in mesh units.
//! \param num_vertices  of the mesh that they belong to.
//! \throw IoError       the file cannot be read, or is no .sol of one number a vertex.
//! \throw InvalidInput  it has another number of values, or one that is not above 0.
//!        Both name the file, the line and the remedy.
//! \throw Cancelled     the progress callback returned false.
//! Cost: O(file size).
[[nodiscard]] std::vector<double> read_lengths(const std::filesystem::path& path,
                                               std::size_t num_vertices,
                                               const Progress& progress = {});

}  // namespace remesh
