//! \file
//! One box with good and bad triangulations: the same surface, so that only the triangles differ.
#pragma once

#include <string>
#include <vector>

#include "agvd/mesh/mesh.h"

namespace bench {

struct NamedMesh {
    std::string name;
    agvd::TriangleMesh mesh;
};

//! The unit cube with about 20 000 faces: right triangles; needles of aspect 1e-3 and 1e-6 along
//! its sides; the first after 400 000 random flips of coplanar edges; the first with a degenerate
//! face at every tenth edge.
[[nodiscard]] std::vector<NamedMesh> coplanar_boxes();

}  // namespace bench
