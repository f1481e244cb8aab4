//! \file
//! The sides of all faces grouped by edge, for code that must work on any mesh, manifold or not.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "agvd/core/poller.h"
#include "agvd/mesh/mesh_view.h"

namespace agvd {

//! One side of one face.
struct EdgeSide {
    std::uint64_t ends;  //!< edge_key of its ends.
    Index half_edge;     //!< 3 f + k runs from corner k to corner k + 1 of face f.
    bool forward;        //!< Runs from the lower vertex to the higher one.

    [[nodiscard]] Index face() const { return half_edge / 3; }
    [[nodiscard]] Index low() const { return static_cast<Index>(ends >> 32); }
    [[nodiscard]] Index high() const { return static_cast<Index>(ends); }
};

//! 3 #F sides, grouped by edge and sorted by face within an edge. Cost: O(n).
[[nodiscard]] std::vector<EdgeSide> sorted_edge_sides(std::span<const Triangle> triangles,
                                                      Ticker ticker = {});

//! Sorts sides by edge, then by half-edge. Cost: linear for bounded vertex degrees.
[[nodiscard]] std::vector<EdgeSide> sort_edge_sides(const std::vector<EdgeSide>& sides,
                                                    Index num_vertices, Ticker ticker);

//! Calls visit(edge) for the sides of each edge, a part of `sides`.
template <typename Visit>
void for_each_edge(std::span<const EdgeSide> sides, const Visit& visit) {
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
        while (end < sides.size() && sides[end].ends == sides[begin].ends) ++end;
        visit(sides.subspan(begin, end - begin));
    }
}

}  // namespace agvd
