//! \file
//! Vertices and polygons as in the file, filled by the readers. Private.
#pragma once

#include <cstdint>

#include "remesh/io/read_mesh.h"
#include "remesh/io/source_file.h"

namespace remesh {

class PolygonSoup {
public:
    //! \param file         named in errors; must outlive the soup.
    //! \param first_index  what the format calls its first vertex: 0, or 1 (OBJ).
    PolygonSoup(const SourceFile& file, int first_index)
        : ticker(file.ticker), file_(file), first_index_(first_index) {}

    std::vector<agvd::Vec3> positions;
    agvd::Ticker ticker;  //!< For code that adds positions; polygons tick it by themselves.

    //! Reserves memory for the announced counts, limited by what the file's size allows.
    void reserve(std::uint64_t vertices, std::uint64_t polygons);

    //! Adds a corner, counted from 0, to the current polygon.
    //! \param offset  its place in the file.
    //! \throw agvd::InvalidInput  it is negative or beyond any index.
    void add_corner(std::int64_t vertex, std::size_t offset);

    void end_polygon() {
        ticker.tick(2);
        polygon_end_.push_back(corners_.size());
    }

    [[nodiscard]] std::size_t num_polygons() const { return polygon_end_.size(); }

    //! Checks the indices against all vertices and cuts the polygons into triangles.
    //! \throw agvd::InvalidInput  an index is out of range, or no triangle is left.
    [[nodiscard]] MeshFile finish() &&;

private:
    const SourceFile& file_;
    int first_index_;
    std::vector<agvd::Index> corners_;
    std::vector<std::size_t> polygon_end_;  // #polygons: end of each in corners_
    agvd::Index highest_ = 0;               // Vertices may follow the faces: checked at the end.
    std::size_t highest_offset_ = 0;
    std::size_t highest_polygon_ = 0;
};

}  // namespace remesh
