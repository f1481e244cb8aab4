//! \file
//! Vertices, polygons, strips and volume cells as in the file. Private to the readers.
#pragma once

#include "remesh/meshfile/mesh_file.h"
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

//! Adds the triangles of one strip to a soup, vertex by vertex.
class StripTriangles {
public:
    explicit StripTriangles(PolygonSoup& soup) : soup_(soup) {}

    void add(std::int64_t vertex, std::size_t offset) {
        const Corner corner{vertex, offset};
        if (length_ >= 2) {
            const bool is_turned = length_ % 2 == 1;
            add_triangle(is_turned ? last_ : before_, is_turned ? before_ : last_, corner);
        }
        before_ = last_;
        last_ = corner;
        ++length_;
    }

    //! A strip of one or two vertices counts as a face of so many corners.
    void end() {
        if (length_ == 1 || length_ == 2) {
            if (length_ == 2) soup_.add_corner(before_.vertex, before_.offset);
            soup_.add_corner(last_.vertex, last_.offset);
            soup_.end_polygon();
        }
        length_ = 0;
    }

private:
    struct Corner {
        std::int64_t vertex = 0;
        std::size_t offset = 0;  // In the file.
    };

    // A vertex that is named twice in a row only turns the strip.
    void add_triangle(const Corner& a, const Corner& b, const Corner& c) {
        if (a.vertex == b.vertex || b.vertex == c.vertex || c.vertex == a.vertex) return;
        for (const Corner& corner : {a, b, c}) soup_.add_corner(corner.vertex, corner.offset);
        soup_.end_polygon();
    }

    PolygonSoup& soup_;
    std::size_t length_ = 0;  // Vertices so far.
    Corner before_, last_;
};

//! Kinds of cells; their corners are numbered as in VTK.
enum class VolumeCell : std::uint8_t { Tetrahedron, Hexahedron, Wedge, Pyramid };

[[nodiscard]] constexpr std::size_t num_corners(VolumeCell kind) {
    return std::array<std::size_t, 4>{4, 8, 6, 5}[static_cast<std::size_t>(kind)];
}

//! Collects cells and gives the faces that belong to one of them only.
class VolumeSurface {
public:
    //! \param file  named in errors; must outlive this.
    explicit VolumeSurface(const SourceFile& file) : file_(file) {}

    //! Adds a corner, counted from 0, to the current cell.
    //! \throw InvalidInput  it is negative or beyond any index.
    void add_corner(std::int64_t vertex, std::size_t offset);
    //! Of the kind that has as many corners as were added.
    void end_cell(VolumeCell kind) { kinds_.push_back(kind); }

    [[nodiscard]] std::size_t num_cells() const { return kinds_.size(); }

    //! Adds the surface to a soup that has all vertices, its faces turned outwards. A soup that has
    //! faces gets no others: the file tells its surface.
    //! \return by face that was added: its cell.
    //! \throw InvalidInput  a cell names a vertex that does not exist.
    //! \throw Cancelled
    //! Cost: linear but for sorting, 24 bytes for each face of each cell.
    [[nodiscard]] std::vector<std::size_t> add_to(PolygonSoup& soup) const;

    //! What add_to did; empty without cells.
    [[nodiscard]] std::string warning(std::size_t num_added) const;

private:
    const SourceFile& file_;
    std::vector<Index> corners_;  // Cell after cell.
    std::vector<VolumeCell> kinds_;
    Index highest_ = 0;
    std::size_t highest_offset_ = 0;
};

}  // namespace remesh
