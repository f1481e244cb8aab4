//! \file
//! Options of `remesh` for what stays of the input.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli.h"
#include "remesh/meshfile/mesh_file.h"

namespace cli {

struct RegionArguments {
    std::string region;          //!< Name of a face property; empty: the whole mesh is remeshed.
    std::filesystem::path lock;  //!< Empty: no vertex is locked.
    bool lock_boundary = false;
};

//! Adds --region, --lock and --lock-boundary, after --sites, --drop-components, --weld and
//! --fill-holes.
void add_region_options(CLI::App& app, RegionArguments& arguments);

//! RemeshOptions::region as --region wants it; empty without it.
//! \param path  of the mesh, for errors.
//! \throw agvd::InvalidOption  there is no such property, or it is 0 for all faces.
[[nodiscard]] std::vector<std::uint8_t> region_for(const RegionArguments& arguments,
                                                   const std::filesystem::path& path,
                                                   const remesh::MeshFile& mesh);

//! The number of vertices of the faces in a region; of the mesh if it is empty. Cost: O(#F).
[[nodiscard]] std::size_t num_vertices_in(const std::vector<std::uint8_t>& region,
                                          const agvd::MeshView& mesh);

}  // namespace cli
