//! \file
//! Joins a remeshed region and the faces that stayed.
#pragma once

#include "agvd/core/progress.h"
#include "remesh/pipeline/cut_region.h"

namespace remesh::detail {

struct GluedRegion {
    TriangleMesh mesh;  //!< Kept vertices and faces first.
    //! The caller's vertices that come first in mesh, ascending.
    std::vector<Index> kept_vertices;
    std::vector<Index> vertex;  //!< #V of the remeshed region: its vertex in mesh.
    bool is_joined = true;      //!< No edge has more faces than in the input.
};

//! An inner edge of the region between two vertices that a kept edge joins as well is flipped; if
//! that is not possible, the mesh is not joined.
//!
//! \param remeshed  has all vertices and edges of the region's seam.
//! Cost: O(n log n).
[[nodiscard]] GluedRegion glue_region(const MeshView& mesh, const Region& region,
                                      const TriangleMesh& remeshed, Ticker& ticker);

}  // namespace remesh::detail
