//! \file
//! First stage: turns the caller's mesh into a surface.
#pragma once

#include "remesh/clean/clean_input.h"
#include "remesh/curves/curve_network.h"
#include "remesh/pipeline/stage_context.h"

namespace remesh::detail {

//! The caller's mesh.
struct InputMesh {
    MeshView view;
    //! The mesh of `view` if it may be emptied; otherwise null.
    TriangleMesh* owned = nullptr;
};

//! The input after cleaning.
struct CleanedInput {
    std::vector<Vec3> welded_positions = {};  //!< See CleanResult.
    //! The caller's mesh, with welded positions if there are any; empty if it was released.
    MeshView given = {};
    Surface surface = {};                   //!< Of the cleaned mesh.
    std::vector<Index> vertex_origin = {};  //!< See CleanResult; empty: nothing was changed.
    std::vector<Index> face_origin = {};    //!< Likewise.
    Topology topology = {};                 //!< Of the surface.
    LockedElements locked = {};             //!< Of the surface.
};

//! Cleans the mesh, and drops small components if the options ask for it. Empties an owned mesh as
//! soon as nothing refers to it, so that a large mesh is in memory only once.
//!
//! \throw as clean_input, drop_components, build_surface and find_locked.
//! Cost: that of clean_input.
[[nodiscard]] CleanedInput clean_stage(const InputMesh& input, const StageContext& context);

}  // namespace remesh::detail
