//! \file
//! The curves that remesh() keeps of a mesh, as lines in colour.
#pragma once

#include <string>
#include <vector>

#include "render/canvas.h"

namespace render {

struct NetworkLines {
    struct Line {
        std::vector<agvd::Vec3> points;
        Color color;  //!< Neighbours usually have different ones.
    };
    std::vector<Line> lines;
    std::vector<agvd::Vec3> nodes;
};

//! Creases as found by default, and the boundary, at the spacing of `num_vertices` (300 or more);
//! junctions left out.
//!
//! \throw agvd::IoError, agvd::InvalidInput  the mesh cannot be read or repaired.
[[nodiscard]] NetworkLines network_lines(const std::string& path, agvd::Index num_vertices);

}  // namespace render
