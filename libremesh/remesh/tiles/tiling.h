//! \file
//! A surface in tiles: parts that are meshed one by one and fit, as the sites on their common
//! borders are chosen before. Private to remeshing.
#pragma once

#include <cstdint>

#include "remesh/tiles/border_sites.h"
#include "remesh/tiles/cut_by_planes.h"

namespace remesh {

//! In spacings: vertices this near to a plane lie on it.
inline constexpr double snap_to_plane = 0.02;
//! Of the area of a tile: parts with less join their neighbour.
inline constexpr double least_share = 0.125;
//! Of smaller tiles too much is border.
inline constexpr Index least_samples_per_tile = 500;

//! How many tiles of at most so many vertices are needed.
[[nodiscard]] constexpr Index num_tiles_for(Index num_vertices, Index per_tile) {
    return num_vertices / per_tile + (num_vertices % per_tile != 0 ? 1 : 0);
}

struct TilingOptions {
    Index num_vertices = 0;  //!< Of the mesh that is to be made.
    Index per_tile = 0;      //!< > 0: vertices of a tile, at most.
    double spacing = 0;      //!< > 0, mesh units: of neighbouring vertices.
    Progress progress = {};
};

//! Parts of a surface and the sites on their borders.
struct Tiling {
    Surface surface;          //!< The given one, its faces cut where tiles meet.
    FaceOrigins parts;        //!< Where its faces lie on the given surface.
    std::vector<Index> tile;  //!< #F.
    Index num_tiles = 0;
    std::vector<std::uint8_t> is_border;  //!< #E: 1 between two tiles.
    BorderSites borders;                  //!< On edges of `surface`.
    std::vector<Index> num_inner;         //!< #tiles: vertices that are none of these sites.
};

//! Divides a surface into tiles of about the same number of vertices. Borders are cut by planes, so
//! they are smooth where the surface is. What a plane cuts off that is much smaller than a tile
//! joins its neighbour. The sites of a border depend on nothing but its length, and on the creases
//! and boundaries that it meets, where there is always one.
//! \param is_crease  #E: 1 for edges that are curves.
//! \throw InvalidInput  a face is too narrow to be cut.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n log n).
[[nodiscard]] Tiling divide_into_tiles(const Surface& surface,
                                       std::span<const std::uint8_t> is_crease,
                                       const TilingOptions& options);

//! A tile as a mesh of its own, in which the sites of its borders are vertices. A vertex at which
//! its faces meet in several fans is a vertex for each fan.
struct Tile {
    TriangleMesh mesh;
    FaceOrigins parts;               //!< Where its faces lie on the surface that was divided.
    std::vector<Index> border_site;  //!< #V: its number; no_index: none.
};

//! \param faces  of the tile, ascending. Cost: O(n log n).
[[nodiscard]] Tile take_tile(const Tiling& tiling, std::span<const Index> faces, Ticker ticker);

}  // namespace remesh
