//! \file
//! Where the vertices and faces of a result lie on its input.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh {

//! `{}` gives the defaults.
struct MapOptions {
    bool with_faces = false;  //!< Also map the faces.
    int num_threads = 0;      //!< >= 0; 0: all cores.
    Progress progress = {};   //!< Polled during the call; see poll.
};

//! Faces of the input at points that are spread evenly over a face of the result.
using FaceSamples = std::array<Index, 16>;

//! Where the elements of a result lie on the input.
struct InputMap {
    std::vector<SurfacePoint> vertices;  //!< #V of the result: points of the input.
    std::vector<FaceSamples> faces;      //!< #F of the result; empty without with_faces.
};

//! For each vertex of a result the point of the input that is nearest to it, on the sheet where the
//! vertex belongs: of the input within the distance of its site only the part counts that is
//! connected with the site there. So walls may be as thin as they like. A vertex that lies at its
//! site up to rounding stays there bit for bit, as those on boundaries and curves do that were not
//! moved. The samples of faces are found in the same way, from their corners.
//!
//! \param input   what remesh() got: any triangles, also dirty ones.
//! \param sites   of the result's vertices, on `input`: RemeshResult::sites.
//! \throw InvalidOption  num_threads < 0, or there is not one site for each vertex.
//! \throw Cancelled      the progress callback returned false.
//! Cost: O(#F of the input); for each vertex the faces of the input between it and its site, for
//! each face of the result 16 times those along a quarter of its width.
[[nodiscard]] InputMap map_to_input(const MeshView& input, const MeshView& result,
                                    std::span<const SurfacePoint> sites,
                                    const MapOptions& options = {});

}  // namespace remesh
