//! \file
//! Large results in tiles: each is meshed on its own, as if it were an input, and all are joined.
#pragma once

#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/tile_mesher.h"

namespace remesh::detail {

//! Whether a run is made in tiles.
[[nodiscard]] bool is_tiled(const CurvedSurface& curved, const RemeshOptions& options);

//! Divides the surface into tiles and meshes them side by side. Adds what the stages tell of each
//! tile to the result.
//! \return unset: a tile has no mesh with so few vertices, or is too narrow to be cut.
//! Cost: that of the stages. In memory are the tiles in work, one for each thread.
[[nodiscard]] std::optional<TileMesh> mesh_in_tiles(const CurvedSurface& curved,
                                                    const StageContext& context);

}  // namespace remesh::detail
