//! \file
//! First stage: the caller's mesh becomes a surface.
#pragma once

#include "remesh/clean/clean_input.h"
#include "remesh/pipeline/stage_context.h"

namespace remesh::detail {

//! The caller's mesh.
struct InputMesh {
    agvd::MeshView view;
    agvd::TriangleMesh* owned = nullptr;  //!< What `view` shows, if it may be emptied; else null.
};

//! The input after cleaning.
struct CleanedInput {
    agvd::MeshView given;        //!< The caller's mesh; empty if that was given away.
    agvd::Surface surface = {};  //!< Of the cleaned mesh.
    std::vector<agvd::Index> vertex_origin = {};  //!< See CleanResult; empty: nothing was changed.
    std::vector<agvd::Index> face_origin = {};    //!< Likewise.
    Topology topology = {};                       //!< Of the surface.
};

//! Cleans the mesh and leaves out small components if the options ask for it. A mesh that may be
//! given away is emptied as soon as nothing refers to it any more, so that large meshes are in
//! memory once.
//!
//! \throw as clean_input, drop_components and agvd::build_surface.
//! Cost: that of clean_input.
[[nodiscard]] CleanedInput clean_stage(const InputMesh& input, const StageContext& context);

}  // namespace remesh::detail
