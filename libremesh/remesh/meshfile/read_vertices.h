//! \file
//! Reads vertices that the user named.
#pragma once

#include <filesystem>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh {

//! A text file with one vertex per line, counted from 0 as in the arrays of read_mesh's result;
//! what follows # is a comment.
//!
//! \throw IoError  the file cannot be read, a line has another form, or there is no vertex.
//! \throw InvalidInput  the mesh has no such vertex, or it is in no face.
//!        Both name the file, the line and the remedy.
//! Cost: O(file size + #F).
[[nodiscard]] std::vector<Index> read_vertices(const std::filesystem::path& path,
                                               const MeshView& mesh, const Progress& progress = {});

}  // namespace remesh
