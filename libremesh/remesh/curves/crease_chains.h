//! \file
//! A set of crease edges and the chains that it consists of.
#pragma once

#include <cstdint>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Consecutive edges. Inner vertices have two edges of the set and are not on the boundary.
struct CreaseChain {
    std::vector<Index> edges;
    Index ends[2] = {no_index, no_index};  //!< Vertices; the same if closed.
    double length = 0;
};

//! A set of inner edges and how many of them meet at each vertex.
class CreaseSet {
public:
    explicit CreaseSet(const Surface& surface)
        : surface_(&surface), is_in_(surface.num_edges()), degree_(surface.num_vertices()) {}

    void add(Index edge) { change(edge, true); }
    void remove(Index edge) { change(edge, false); }
    [[nodiscard]] bool has(Index edge) const { return is_in_[edge] != 0; }
    //! The first edge of the set from `edge` on; the number of edges if there is none.
    [[nodiscard]] Index next(Index edge) const;
    [[nodiscard]] Index degree(Index vertex) const { return degree_[vertex]; }
    //! A chain ends here, away from other chains and from the boundary.
    [[nodiscard]] bool is_open_end(Index vertex) const {
        return degree_[vertex] == 1 && !surface_->is_boundary_vertex(vertex);
    }
    //! A chain passes through here.
    [[nodiscard]] bool is_inner(Index vertex) const {
        return degree_[vertex] == 2 && !surface_->is_boundary_vertex(vertex);
    }
    [[nodiscard]] const Surface& surface() const { return *surface_; }
    [[nodiscard]] std::vector<std::uint8_t> take_flags() { return std::move(is_in_); }

private:
    void change(Index edge, bool is_in) {
        if (has(edge) == is_in) return;
        is_in_[edge] = is_in ? 1 : 0;
        const Index h = surface_->edge_half[edge];
        for (const Index v : {surface_->tail(h), surface_->head(h)}) {
            degree_[v] += is_in ? 1 : no_index;  // Minus one.
        }
    }

    const Surface* surface_;
    std::vector<std::uint8_t> is_in_;  // #E.
    std::vector<Index> degree_;        // #V.
};

//! The chain that holds the edge.
[[nodiscard]] CreaseChain chain_of(const CreaseSet& set, Index edge);

//! All chains, ascending by their lowest edge. Cost: O(#E).
[[nodiscard]] std::vector<CreaseChain> chains_of(const CreaseSet& set, Poller& poller);

}  // namespace remesh::detail
