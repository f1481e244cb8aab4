//! \file
//! Edges and vertices of any triangles, manifold or not.
#pragma once

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"

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

//! Whether an edge joins the tail of a half-edge to a vertex, in the fan of triangles that holds
//! the half-edge.
//!
//! \param twin  #H; no_index where the fan ends.
//! Cost: O(triangles of the fan).
[[nodiscard]] inline bool are_joined(std::span<const Triangle> triangles,
                                     std::span<const Index> twin, Index half_edge, Index vertex) {
    const auto holds = [&](Index h) {  // The triangle of h, which leaves the tail.
        const Index head = next_half_edge(h), apex = previous_half_edge(h);
        return triangles[h / 3][head % 3] == vertex || triangles[h / 3][apex % 3] == vertex;
    };
    Index h = half_edge;
    do {
        if (holds(h)) return true;
        h = twin[previous_half_edge(h)];
    } while (h != no_index && h != half_edge);
    if (h == half_edge) return false;
    for (h = twin[half_edge]; h != no_index; h = twin[h]) {
        h = next_half_edge(h);
        if (holds(h)) return true;
    }
    return false;
}

//! For each position the first one that is equal to it.
//! \param is_wanted  false: left out, and no_index in the result; or empty.
//! Cost: O(n) expected.
[[nodiscard]] std::vector<Index> first_at_position(std::span<const Vec3> positions, Ticker& ticker,
                                                   const std::vector<bool>& is_wanted = {});

//! The faces with first[v] in place of each vertex v.
[[nodiscard]] std::vector<Triangle> rename_vertices(std::span<const Triangle> triangles,
                                                    std::span<const Index> first);

//! Numbers the vertices that triangles have anew, in their order.
//! \return these, ascending. Cost: O(n).
std::vector<Index> drop_unused(Index num_vertices, std::vector<Triangle>& triangles);

}  // namespace agvd
