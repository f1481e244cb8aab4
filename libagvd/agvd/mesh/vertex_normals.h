//! \file
//! Normals at the vertices of a mesh.
#pragma once

#include <vector>

#include "agvd/mesh/mesh_view.h"

namespace agvd {

//! #V unit vectors: the mean of the normals of the faces around each vertex, weighted by their
//! angles there ([thurmer1998]). Zero where there is no face, or none with area.
//! Cost: O(n).
[[nodiscard]] std::vector<Vec3> vertex_normals(const MeshView& mesh);

}  // namespace agvd
