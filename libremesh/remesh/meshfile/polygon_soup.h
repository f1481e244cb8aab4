//! \file
//! Vertices and polygons as in the file, filled by the readers. Private.
#pragma once

#include <cstdint>
#include <span>

#include "remesh/meshfile/read_mesh.h"
#include "remesh/meshfile/source_file.h"

namespace remesh {

//! Texture coordinates as in the file.
struct SoupTexture {
    std::vector<Vec2> values;             //!< Shared by corners.
    std::optional<NumberType> type = {};  //!< See TextureCoordinates.
    bool is_of_vertices = false;          //!< Value i belongs to vertex i.
    //! Otherwise by corner, in the order of the polygons: its value, or no_index. Corners beyond
    //! the end have none.
    std::vector<Index> of_corner;
    bool is_broken = false;  //!< Some of it is no finite number, or does not exist.
    std::string name;        //!< What the file calls them; empty: it has none.

    //! The value of the last of `num_corners` corners so far.
    void set_corner(std::size_t num_corners, Index value) {
        of_corner.resize(num_corners - 1, no_index);
        of_corner.push_back(value);
    }
    void add(double u, double v) {
        values.emplace_back(u, v);
        is_broken = is_broken || !values.back().allFinite();
    }
};

class PolygonSoup {
public:
    //! \param file         named in errors; must outlive the soup.
    //! \param first_index  what the format calls its first vertex: 0, or 1 (OBJ).
    PolygonSoup(const SourceFile& file, int first_index)
        : ticker(file.ticker), file_(file), first_index_(first_index) {}

    std::vector<Vec3> positions;
    Ticker ticker;  //!< For code that adds positions; polygons tick it by themselves.

    //! Reserves memory for the announced counts, limited by what the file's size allows.
    void reserve(std::uint64_t vertices, std::uint64_t polygons);

    //! Adds a corner, counted from 0, to the current polygon.
    //! \param offset  its place in the file.
    //! \throw InvalidInput  it is negative or beyond any index.
    void add_corner(std::int64_t vertex, std::size_t offset);

    void end_polygon() {
        ticker.tick(2);
        polygon_end_.push_back(corners_.size());
    }

    [[nodiscard]] std::size_t num_polygons() const { return polygon_end_.size(); }
    [[nodiscard]] std::size_t num_corners() const { return corners_.size(); }
    //! The vertex of a corner.
    [[nodiscard]] Index corner(std::size_t i) const { return corners_[i]; }

    SoupTexture texture;  //!< For readers that find texture coordinates.

    //! Checks the indices against all vertices and cuts the polygons into triangles. The result's
    //! attributes are its texture coordinates.
    //! \throw InvalidInput  an index is out of range, or no triangle is left.
    [[nodiscard]] MeshFile finish() &&;

private:
    [[nodiscard]] TextureCoordinates texture_of(const TriangleMesh& mesh,
                                                std::span<const std::size_t> corner);

    const SourceFile& file_;
    int first_index_;
    std::vector<Index> corners_;
    std::vector<std::size_t> polygon_end_;  // #polygons: end of each in corners_
    Index highest_ = 0;                     // Vertices may follow the faces: checked at the end.
    std::size_t highest_offset_ = 0;
    std::size_t highest_polygon_ = 0;
};

}  // namespace remesh
