//! \file
//! Triangles whose edges can be flipped. Private to the dual.
#pragma once

#include <span>
#include <unordered_set>
#include <vector>

#include "agvd/core/half_edge.h"
#include "agvd/core/poller.h"

namespace remesh {

//! Half-edge 3 t + k runs from corner k to corner k + 1 of triangle t. Edges are numbered by their
//! two ends, ascending, and keep their number in a flip.
class FlippableMesh {
public:
    //! Accepts any triangles. Edges without exactly two sides in opposite directions never flip.
    explicit FlippableMesh(std::span<const agvd::Triangle> triangles, agvd::Ticker ticker = {});

    [[nodiscard]] const std::vector<agvd::Triangle>& triangles() const { return triangles_; }
    [[nodiscard]] agvd::Index num_edges() const { return static_cast<agvd::Index>(sides_.size()); }
    [[nodiscard]] agvd::Index edge(agvd::Index half_edge) const { return edge_[half_edge]; }
    //! The two half-edges of an inner edge; at the start the first one leaves its lower end. The
    //! second is no_index for edges that never flip.
    [[nodiscard]] const std::array<agvd::Index, 2>& sides(agvd::Index edge) const {
        return sides_[edge];
    }
    [[nodiscard]] bool is_inner(agvd::Index edge) const {
        return sides_[edge][1] != agvd::no_index;
    }
    [[nodiscard]] agvd::Index tail(agvd::Index half_edge) const {
        return triangles_[half_edge / 3][half_edge % 3];
    }
    [[nodiscard]] static constexpr agvd::Index next(agvd::Index half_edge) {
        return agvd::next_half_edge(half_edge);
    }
    [[nodiscard]] static constexpr agvd::Index previous(agvd::Index half_edge) {
        return agvd::previous_half_edge(half_edge);
    }

    //! Whether the mesh stays a simplicial complex: the new edge does not exist yet, and no vertex
    //! is left with fewer than three edges (two on the boundary).
    [[nodiscard]] bool can_flip(agvd::Index edge) const;
    //! Flips an edge: it then joins the corners that were opposite to it.
    void flip(agvd::Index edge);

private:
    [[nodiscard]] bool has_edge(std::uint64_t ends) const;

    std::vector<agvd::Triangle> triangles_;
    std::vector<agvd::Index> edge_;                  // #H
    std::vector<std::array<agvd::Index, 2>> sides_;  // #E
    std::vector<agvd::Index> valence_;               // By vertex: number of edges.
    std::vector<bool> is_boundary_;                  // By vertex.
    // Ends of the initial edges, ascending; those that flips removed, and those that they added.
    std::vector<std::uint64_t> first_ends_;
    std::unordered_set<std::uint64_t> removed_, added_;
};

}  // namespace remesh
