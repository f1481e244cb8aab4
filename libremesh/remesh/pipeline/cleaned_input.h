//! \file
//! First stage: turns the caller's mesh into a surface, and carries the caller's sites to it.
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
    std::vector<Index> face_origin = {};    //!< See CleanResult; alone: only the order changed.
    Topology topology = {};                 //!< Of the surface.
    LockedElements locked = {};             //!< Of the surface.
    //! Of a coarse input (see coarse_input) the one that it stands for; otherwise null.
    const CleanedInput* finer = nullptr;
    std::vector<Index> finer_vertex = {};    //!< #V: of a coarse input, which vertex each is there.
    std::vector<std::uint8_t> creases = {};  //!< #E: of a coarse input; empty: there are none.

    //! The one without a finer one.
    [[nodiscard]] const CleanedInput& finest() const { return finer != nullptr ? *finer : *this; }
};

//! The options for a clean_input() at the beginning of a run.
[[nodiscard]] inline CleanOptions cleaning_of(const RemeshOptions& options) {
    CleanOptions cleaning = options.cleaning;
    cleaning.num_threads = options.num_threads;
    cleaning.progress = progress_at(Stage::Clean, options, 0);
    return cleaning;
}

//! Cleans the mesh, and drops small components if the options ask for it. Empties an owned mesh as
//! soon as nothing refers to it, so that a large mesh is in memory only once.
//! \throw as clean_input, drop_components, build_surface and find_locked.
//! Cost: that of clean_input.
[[nodiscard]] CleanedInput clean_stage(const InputMesh& input, const StageContext& context);

//! Whether sites, edges, labels or lengths refer to the caller's mesh.
[[nodiscard]] bool refers_to_input(const RemeshOptions& options);

//! The caller's sites on the cleaned surface.
//! \param surface  the cleaned one, which a later stage may own by now.
//! \throw as to_cleaned.
//! \throw InvalidSites  of 1000 sites or more, more than half lie where an earlier one does.
//! Cost: that of to_cleaned and distinct_points.
[[nodiscard]] std::vector<SurfacePoint> given_sites(const CleanedInput& cleaned,
                                                    const Surface& surface,
                                                    const std::vector<SurfacePoint>& sites);

}  // namespace remesh::detail
