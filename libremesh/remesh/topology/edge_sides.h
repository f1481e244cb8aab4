//! \file
//! The sides of all faces grouped by edge, for measures that must work on any mesh, manifold or
//! not.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "agvd/core/poller.h"
#include "agvd/mesh/mesh_view.h"

namespace remesh {

//! One side of one face.
struct EdgeSide {
    std::uint64_t ends;     //!< Lower vertex << 32 | higher vertex.
    agvd::Index half_edge;  //!< 3 f + k runs from corner k to corner k + 1 of face f.
    bool forward;           //!< Runs from the lower vertex to the higher one.

    [[nodiscard]] agvd::Index face() const { return half_edge / 3; }
    [[nodiscard]] agvd::Index low() const { return static_cast<agvd::Index>(ends >> 32); }
    [[nodiscard]] agvd::Index high() const { return static_cast<agvd::Index>(ends); }
};

//! 3 #F sides, those of one edge side by side, by face within. Cost: O(n).
[[nodiscard]] std::vector<EdgeSide> sorted_edge_sides(std::span<const agvd::Triangle> triangles,
                                                      agvd::Ticker ticker = {});

//! Calls visit(begin, end), pointers into `sides`, once for each edge.
template <typename Visit>
void for_each_edge(const std::vector<EdgeSide>& sides, const Visit& visit) {
    const EdgeSide* const last = sides.data() + sides.size();
    for (const EdgeSide *begin = sides.data(), *end = begin; begin != last; begin = end) {
        while (end != last && end->ends == begin->ends) ++end;
        visit(begin, end);
    }
}

}  // namespace remesh
