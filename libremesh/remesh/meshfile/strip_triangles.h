//! \file
//! Triangle strips: each vertex from the third one on makes a triangle with the two before it;
//! every second triangle is turned round, so that all face the same way. Private to the readers.
#pragma once

#include "remesh/meshfile/polygon_soup.h"

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

}  // namespace remesh
