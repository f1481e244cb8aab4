//! \file
//! A set of crease edges and the chains that it consists of.
#pragma once

#include <cstdint>
#include <vector>

#include "agvd/core/poller.h"
#include "agvd/mesh/surface.h"

namespace remesh::detail {

//! Consecutive edges. Inner vertices have two edges of the set and are not on the boundary.
struct CreaseChain {
    std::vector<agvd::Index> edges;
    agvd::Index ends[2] = {agvd::no_index, agvd::no_index};  //!< Vertices; the same if closed.
    double length = 0;
};

//! A set of inner edges and how many of them meet at each vertex.
class CreaseSet {
public:
    explicit CreaseSet(const agvd::Surface& surface)
        : surface_(&surface), is_in_(surface.num_edges()), degree_(surface.num_vertices()) {}

    void add(agvd::Index edge) { change(edge, true); }
    void remove(agvd::Index edge) { change(edge, false); }
    [[nodiscard]] bool has(agvd::Index edge) const { return is_in_[edge] != 0; }
    //! The first edge of the set from `edge` on; the number of edges if there is none.
    [[nodiscard]] agvd::Index next(agvd::Index edge) const;
    [[nodiscard]] agvd::Index degree(agvd::Index vertex) const { return degree_[vertex]; }
    //! A chain ends here, away from other chains and from the boundary.
    [[nodiscard]] bool is_open_end(agvd::Index vertex) const {
        return degree_[vertex] == 1 && !surface_->is_boundary_vertex(vertex);
    }
    //! A chain passes through here.
    [[nodiscard]] bool is_inner(agvd::Index vertex) const {
        return degree_[vertex] == 2 && !surface_->is_boundary_vertex(vertex);
    }
    [[nodiscard]] const agvd::Surface& surface() const { return *surface_; }
    [[nodiscard]] std::vector<std::uint8_t> take_flags() { return std::move(is_in_); }

private:
    void change(agvd::Index edge, bool is_in) {
        if (has(edge) == is_in) return;
        is_in_[edge] = is_in ? 1 : 0;
        const agvd::Index h = surface_->edge_half[edge];
        for (const agvd::Index v : {surface_->tail(h), surface_->head(h)}) {
            degree_[v] += is_in ? 1 : agvd::no_index;  // Minus one.
        }
    }

    const agvd::Surface* surface_;
    std::vector<std::uint8_t> is_in_;  // #E.
    std::vector<agvd::Index> degree_;  // #V.
};

//! The chain that holds the edge.
[[nodiscard]] CreaseChain chain_of(const CreaseSet& set, agvd::Index edge);

//! All chains, ascending by their lowest edge. Cost: O(#E).
[[nodiscard]] std::vector<CreaseChain> chains_of(const CreaseSet& set, agvd::Poller& poller);

}  // namespace remesh::detail
