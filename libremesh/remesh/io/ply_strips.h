//! \file
//! Triangle strips of PLY, as scans of Stanford's repository have them. Private to the reader.
//! The element tristrips holds lists of vertices, and -1 ends a strip. Each vertex from the third
//! one on makes a triangle with the two before it; every second triangle is turned round, so that
//! all face the same way.
#pragma once

#include "remesh/io/ply_values.h"
#include "remesh/io/polygon_soup.h"

namespace remesh {

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

//! Reads the element tristrips.
//! \throw agvd::IoError  it has no list of whole numbers, or is truncated.
//! \throw agvd::InvalidInput  a vertex is negative and not -1, or beyond any index.
template <typename Values>
void read_strips(Values& values, const PlyElement& element, const SourceFile& file,
                 PolygonSoup& soup) {
    const PlyProperty& corners = require_corners(element, file);
    for (std::uint64_t i = 0; i < element.count; ++i) {
        values.begin(element, i);
        for (const PlyProperty& property : element.properties) {
            if (&property != &corners) {
                skip_property(values, property, file);
                continue;
            }
            StripTriangles strip(soup);
            for (std::int64_t k = read_length(values, property, file); k > 0; --k) {
                const std::size_t start = values.offset();
                const std::int64_t vertex = values.integer(property.type);
                soup.ticker.tick();
                if (vertex == -1) {
                    strip.end();
                } else {
                    strip.add(vertex, start);
                }
            }
            strip.end();
        }
        values.end();
    }
}

}  // namespace remesh
