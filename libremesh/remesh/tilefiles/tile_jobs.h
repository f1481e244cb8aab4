//! \file
//! Meshes that are larger than memory, or shared by several machines: a file is cut into tiles,
//! each tile becomes a mesh, and these are joined. Each step reads and writes files of one folder:
//!
//!     plan.json      what all steps share; written last by split_into_tiles
//!     00007.tile     a tile: its faces, and the sites on its borders
//!     00007.mesh     its mesh
//!
//! Files appear whole or not at all, and a file that is there is not made again. So a step that was
//! stopped goes on where it was, and tiles are meshed in any order, by any number of processes that
//! share the folder. The bytes of the result do not depend on that.
//! Held by TileJobs in tests/remesh/tilefiles.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/topology.h"
#include "remesh/pipeline/remesh.h"

namespace remesh {

//! How a file is cut, and how its tiles are meshed. `{}` gives the defaults.
struct SplitOptions {
    Index num_samples = RemeshOptions{}.num_samples;  //!< Vertices of the whole result, >= 1.
    //! Vertices of a tile, at most, >= 500. A tile takes some 5 kB for each of them, and some 100
    //! bytes for each of its faces.
    Index samples_per_tile = RemeshOptions{}.samples_per_tile;
    std::uint64_t seed = RemeshOptions{}.seed;      //!< See RemeshOptions.
    int relax_steps = RemeshOptions{}.relax_steps;  //!< >= 1.
    int num_threads = 0;                            //!< >= 0; 0: all cores.
    Progress progress = {};                         //!< Polled during the call; see poll.
};

//! What plan.json holds.
struct TilePlan {
    std::string input;                //!< Path of the file, as it was given.
    std::uint64_t input_bytes = 0;    //!< Its size.
    std::uint64_t num_faces = 0;      //!< Of the file.
    double area = 0;                  //!< Square mesh units.
    double spacing = 0;               //!< Mesh units: of the vertices of the result.
    Index num_samples = 0;            //!< See SplitOptions, as the next three.
    Index samples_per_tile = 0;       //!< See SplitOptions.
    std::uint64_t seed = 0;           //!< See SplitOptions.
    int relax_steps = 0;              //!< See SplitOptions.
    std::vector<Index> num_vertices;  //!< By tile: of its mesh, those on borders included.
    Index num_sites = 0;              //!< On all borders.
    //! What the sum of the Euler characteristics of the tiles has too much: further copies of the
    //! vertices on borders, minus those of the edges.
    std::int64_t border_euler = 0;
    //! Mesh units: of the creases inside tiles (find_creases), which tiles do not keep.
    double crease_length = 0;

    //! How many tiles there are.
    [[nodiscard]] Index num_tiles() const { return static_cast<Index>(num_vertices.size()); }
};

//! Cuts a file into tiles. It is read twice and mapped, not loaded: memory follows the tiles in
//! work and the faces at their borders. Tiles are cut by planes, so borders are smooth where the
//! surface is. Creases are not kept, but measured, and only what lies inside a tile is cleaned (see
//! clean_input).
//! \param file    binary PLY with triangles, or binary STL.
//! \param folder  is made if it does not exist.
//! \return the plan. One that is there already is kept if the file's path and size and the options
//!         are the same.
//! \throw IoError        a file cannot be read or written, or has another format.
//! \throw InvalidInput   a face has no corner or no finite one, more than two faces meet at an edge
//!        of a border, or two do not run the same way; or there are no faces.
//! \throw InvalidOption  an option is out of range, or the folder has another plan.
//! \throw Cancelled      the progress callback returned false: there is no plan, and the next call
//!        begins anew.
//! Cost: O(n log #tiles).
TilePlan split_into_tiles(const std::filesystem::path& file, const std::filesystem::path& folder,
                          const SplitOptions& options = {});

//! \throw IoError  there is no plan.
[[nodiscard]] TilePlan read_tile_plan(const std::filesystem::path& folder);

//! Whether the mesh of a tile is there.
[[nodiscard]] bool is_meshed(const std::filesystem::path& folder, Index tile);

//! How tiles are worked on; the bytes do not depend on it.
struct TileJobOptions {
    int num_threads = 0;     //!< >= 0; 0: all cores.
    Progress progress = {};  //!< Polled during the call; see poll.
};

//! How many tiles have a mesh.
struct MeshedTiles {
    Index made = 0;   //!< Now.
    Index there = 0;  //!< Before.
};

//! Makes the meshes of tiles, as many side by side as there are threads, unless they are there. A
//! tile that fails does not stop the others.
//! \param tiles  their numbers.
//! \throw IoError          a file cannot be read or written.
//! \throw InvalidInput     the surface is not clean at a border, or cannot be cleaned inside.
//! \throw ConstraintUnmet  a tile gets too few vertices for its topology.
//! \throw InvalidOption    there is no such tile.
//! \throw Cancelled        the progress callback returned false; tiles that are finished stay.
//! Cost: that of remesh() for each tile.
MeshedTiles mesh_tiles(const std::filesystem::path& folder, std::span<const Index> tiles,
                       const TileJobOptions& options = {});

//! All tiles as one mesh.
struct JoinedTiles {
    TriangleMesh mesh;  //!< Oriented and manifold.
    Topology topology;  //!< Of the mesh.
    //! Pairs of faces that intersect; unset: without CGAL.
    std::optional<Index> self_intersections = {};
};

//! Joins the meshes of all tiles, relaxes the vertices near borders, and checks that the mesh is an
//! oriented manifold with the Euler characteristic of the tiles together. In memory are the result
//! and the surface near the borders.
//! \throw IoError          the mesh of a tile is not there, or does not belong to the plan.
//! \throw ConstraintUnmet  the meshes do not fit together.
//! \throw Cancelled        the progress callback returned false.
//! Cost: O(n log n), n = vertices of the result and faces near borders.
[[nodiscard]] JoinedTiles join_tiles(const std::filesystem::path& folder,
                                     const TileJobOptions& options = {});

}  // namespace remesh
