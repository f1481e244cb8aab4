//! \file
//! Carries sites between the caller's mesh and the cleaned mesh.
#pragma once

#include "agvd/mesh/mesh.h"
#include "remesh/clean/clean_input.h"

namespace remesh {

//! The same points on `clean.mesh`; `clean` must come from clean_input(mesh). A face that has kept
//! its corners keeps the coordinates bit for bit, so that sites on vertices and edges stay there; a
//! site on a face that was split or dropped goes to the closest point. Coordinates whose sum is 1
//! only to the decimals of a file are divided by it.
//! \throw InvalidSites  a site's face does not exist, its coordinates are not barycentric, or
//!        its face was dropped and no other surface is there (within 1e-9 of the box diagonal); the
//!        text names the site.
//! Cost: O(#F log #F + #sites log #F).
[[nodiscard]] std::vector<SurfacePoint> to_cleaned(const std::vector<SurfacePoint>& sites,
                                                   const MeshView& mesh, const CleanedView& clean);

//! The reverse: points of `clean.mesh` on the mesh that it came from. A point of a part of a face
//! goes to the closest point of the whole face. Without clean.face_origin the mesh was clean:
//! coordinates are only divided by their sum. Cost: O(#sites).
[[nodiscard]] std::vector<SurfacePoint> to_original(const std::vector<SurfacePoint>& sites,
                                                    const MeshView& mesh, const CleanedView& clean);

}  // namespace remesh
