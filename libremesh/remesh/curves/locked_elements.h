//! \file
//! Vertices and edges of a surface that its mesh keeps.
#pragma once

#include <cstdint>
#include <vector>

#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh {

struct LockedElements {
    std::vector<Index> vertices;        //!< Ascending; the ends of the edges are among them.
    std::vector<std::uint8_t> is_edge;  //!< #E: 1 for locked edges; empty: none.

    [[nodiscard]] bool empty() const { return vertices.empty(); }
    [[nodiscard]] bool has_edge(Index edge) const { return !is_edge.empty() && is_edge[edge] != 0; }
};

}  // namespace remesh
