//! \file
//! Triangle strips of PLY, as scans of Stanford's repository have them. Private to the reader.
//! The element tristrips holds lists of vertices, and -1 ends a strip.
#pragma once

#include "remesh/meshfile/ply_values.h"
#include "remesh/meshfile/strip_triangles.h"

namespace remesh {

//! Reads the element tristrips.
//! \throw IoError  it has no list of whole numbers, or is truncated.
//! \throw InvalidInput  a vertex is negative and not -1, or beyond any index.
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
