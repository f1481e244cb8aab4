//! \file
//! Reads vertices that the user named.
#pragma once

#include <filesystem>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh_view.h"

namespace remesh {

//! A text file with one vertex per line, counted from 0 as in the arrays of read_mesh's result;
//! what follows # is a comment.
//!
//! \throw agvd::IoError  the file cannot be read, a line has another form, or there is no vertex.
//! \throw agvd::InvalidInput  the mesh has no such vertex, or it is in no face.
//!        Both name the file, the line and the remedy.
//! Cost: O(file size + #F).
[[nodiscard]] std::vector<agvd::Index> read_vertices(const std::filesystem::path& path,
                                                     const agvd::MeshView& mesh,
                                                     const agvd::Progress& progress = {});

}  // namespace remesh
