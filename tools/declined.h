//! \file
//! Attributes that a file has and the result cannot have: of the program and the Python module.
#pragma once

#include <string>
#include <vector>

#include "remesh/meshfile/mesh_file.h"

namespace cli {

//! Texts for warnings, one for each reason.
[[nodiscard]] std::vector<std::string> describe(
    const std::vector<remesh::DeclinedAttribute>& declined);

//! Removes what the format cannot hold, and adds it to what is declined.
//! \throw agvd::IoError  the format is unknown.
void decline_unwritable(const remesh::MeshPath& output, remesh::MeshAttributes& attributes);

}  // namespace cli
