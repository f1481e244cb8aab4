//! \file
//! The files of a folder with tiles. Private to the jobs on tiles.
#pragma once

#include "remesh/placement/placement.h"
#include "remesh/tilefiles/tile_jobs.h"

namespace remesh {

//! A site on an edge of a border.
struct TileSite {
    Index edge;    //!< Of TileFile::border.
    double share;  //!< In [0, 1]: from its first vertex.
    Index number;  //!< Among all sites.
};

//! A part of the surface, to be meshed on its own.
struct TileFile {
    std::uint64_t plan = 0;  //!< See identity_of().
    Index num_vertices = 0;  //!< Of its mesh.
    TriangleMesh mesh = {};
    std::vector<std::array<Index, 2>> border = {};  //!< Edges; its faces lie on their left.
    std::vector<TileSite> sites = {};               //!< By edge, then along it.
};

//! The mesh of a tile, and the surface near its borders.
struct TileMeshFile {
    std::uint64_t plan = 0;
    std::int64_t euler = 0;  //!< V - E + F of the tile.
    TriangleMesh mesh = {};
    std::vector<Vec3> foot = {};          //!< #V: where each vertex lies on the surface.
    std::vector<Index> border_site = {};  //!< #V: the number of its site; no_index: none.
    TriangleMesh strip = {};              //!< The surface near the borders.
    std::vector<Index> near = {};  //!< Ascending: the vertices that may move when tiles are joined.
    std::vector<SurfacePoint> points = {};  //!< Of these, on the strip.
};

[[nodiscard]] std::filesystem::path plan_path(const std::filesystem::path& folder);
[[nodiscard]] std::filesystem::path tile_path(const std::filesystem::path& folder, Index tile);
[[nodiscard]] std::filesystem::path mesh_path(const std::filesystem::path& folder, Index tile);

//! V - E + F of a mesh.
[[nodiscard]] std::int64_t euler_of(const Topology& topology);

//! A number that differs for different plans, to tell which files belong together.
[[nodiscard]] std::uint64_t identity_of(const TilePlan& plan);

//! \throw IoError  as write_file_atomically.
void write_tile_plan(const std::filesystem::path& folder, const TilePlan& plan);
void write_tile(const std::filesystem::path& folder, Index number, const TileFile& tile);
void write_tile_mesh(const std::filesystem::path& folder, Index number, const TileMeshFile& mesh);

//! \throw IoError  it is not there, damaged, or of another plan.
[[nodiscard]] TileFile read_tile(const std::filesystem::path& folder, Index number,
                                 std::uint64_t plan);
[[nodiscard]] TileMeshFile read_tile_mesh(const std::filesystem::path& folder, Index number,
                                          std::uint64_t plan);

//! The bytes of a mesh: its numbers of vertices and faces, positions in double, corners.
void append_mesh(std::string& bytes, const MeshView& mesh);

//! Takes values from bytes.
class ByteReader {
public:
    //! \param path   for texts.
    //! \param bytes  outlives this.
    ByteReader(const std::filesystem::path& path, std::string_view bytes)
        : path_(path), left_(bytes) {}

    [[nodiscard]] bool is_at_end() const { return left_.empty(); }
    //! \throw IoError  the bytes end before.
    [[nodiscard]] std::uint64_t take_count();
    [[nodiscard]] Index take_index();
    [[nodiscard]] double take_real();
    [[nodiscard]] Vec3 take_position();
    [[nodiscard]] TriangleMesh take_mesh();
    //! As many items as the count before them says.
    template <typename Take>
    [[nodiscard]] auto take_all(const Take& take) {
        const std::uint64_t count = take_count();
        require(count);  // An item takes a byte at least.
        std::vector<decltype(take())> items;
        items.reserve(count);
        for (std::uint64_t i = 0; i < count; ++i) items.push_back(take());
        return items;
    }
    [[noreturn]] void fail() const;

private:
    void require(std::uint64_t size) const {
        if (left_.size() < size) fail();
    }
    template <typename T>
    [[nodiscard]] T take();

    const std::filesystem::path& path_;
    std::string_view left_;
};

}  // namespace remesh
