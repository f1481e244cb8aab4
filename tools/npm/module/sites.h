//! \file
//! Sites as JavaScript's callers give them.
#pragma once

#include <string>
#include <vector>

#include "agvd/mesh/mesh.h"
#include "message.h"
#include "run.h"

namespace npm {

//! Of arrays NAME (vertices), NAME.points (the nearest points of the mesh count), or NAME.faces and
//! NAME.barycentric. A site of no face is left to the library to refuse.
//! \throw agvd::InvalidSites  a vertex is none of a face.
[[nodiscard]] std::vector<agvd::SurfacePoint> sites_of(const Request& request,
                                                       const std::string& name,
                                                       const agvd::MeshView& mesh, Run& run);

}  // namespace npm
