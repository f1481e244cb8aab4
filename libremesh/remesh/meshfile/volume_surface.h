//! \file
//! The surface of tetrahedra, hexahedra and the like. Private to the readers.
#pragma once

#include <array>
#include <span>

#include "remesh/meshfile/polygon_soup.h"

namespace remesh {

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
