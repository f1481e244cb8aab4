//! \file
//! Meshes with all their values, as messages.
#pragma once

#include "message.h"
#include "remesh/meshfile/mesh_file.h"

namespace npm {

//! The mesh of a request: copies its arrays. Key `mesh` and arrays: see src/mesh.ts.
//! \throw agvd::InvalidInput  lengths of arrays do not fit.
[[nodiscard]] remesh::MeshFile mesh_of(const Request& request);

//! Without the values of vertices and faces: not copied.
[[nodiscard]] agvd::MeshView view_of(const Request& request);

//! Adds a mesh to an answer.
void add_mesh(remesh::MeshFile file, Answer& answer);

}  // namespace npm
