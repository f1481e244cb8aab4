//! \file
//! Meshes one tile.
#pragma once

#include "remesh/pipeline/cleaned_input.h"
#include "remesh/pipeline/improvable_mesh.h"

namespace remesh::detail {

//! A tile as a surface of its own.
struct TileInput {
    //! Its locked edges are the borders to other tiles, its locked vertices their sites.
    CleanedInput cleaned = {};
    std::vector<std::uint8_t> is_crease = {};  //!< #E: 1 inside the tile; empty: none.
    std::vector<Index> border_site = {};       //!< #V: the number of its site; no_index: none.
    double spacing = 0;                        //!< Mesh units: of the vertices.
    //! Whether bad triangles are improved: not if the whole mesh will be.
    bool is_improved = false;
};

//! Locks the vertices that are sites of borders. Cost: O(#V).
void lock_sites(TileInput& tile);

//! The mesh of a tile, or of all tiles.
struct TileMesh {
    PlacedMesh mesh;
    std::vector<Index> border_site = {};  //!< #V: the number of its site; no_index: none.
    //! On the surface of the mesh: see NetworkSites.
    std::vector<SurfacePoint> narrow_points = {};
};

//! Runs the stages from sampling to placement.
//! \param context  its num_samples are the vertices of the tile, those of borders included.
//! \return nothing: the samples are too few, or there is no mesh that keeps the borders.
//! \throw InvalidInput  a face is too narrow.
//! Cost: that of a run.
[[nodiscard]] std::optional<TileMesh> mesh_tile(const TileInput& tile, const StageContext& context);

}  // namespace remesh::detail
