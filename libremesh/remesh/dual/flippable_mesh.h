//! \file
//! Triangles whose edges can be flipped. Private to the dual.
#pragma once

#include <span>
#include <unordered_set>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh {

//! Half-edge 3 t + k runs from corner k to corner k + 1 of triangle t. Edges are numbered by their
//! two ends, ascending, and keep their number in a flip.
class FlippableMesh {
public:
    //! Accepts any triangles. Edges without exactly two sides in opposite directions never flip.
    explicit FlippableMesh(std::span<const Triangle> triangles, Ticker ticker = {});

    [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
    [[nodiscard]] Index num_edges() const { return static_cast<Index>(sides_.size()); }
    [[nodiscard]] Index edge(Index half_edge) const { return edge_[half_edge]; }
    //! The two half-edges of an inner edge; at the start the first one leaves its lower end. The
    //! second is no_index for edges that never flip.
    [[nodiscard]] const std::array<Index, 2>& sides(Index edge) const { return sides_[edge]; }
    [[nodiscard]] bool is_inner(Index edge) const { return sides_[edge][1] != no_index; }
    [[nodiscard]] Index tail(Index half_edge) const {
        return triangles_[half_edge / 3][half_edge % 3];
    }
    [[nodiscard]] static constexpr Index next(Index half_edge) { return next_half_edge(half_edge); }
    [[nodiscard]] static constexpr Index previous(Index half_edge) {
        return previous_half_edge(half_edge);
    }

    //! Whether the mesh stays a simplicial complex: the new edge does not exist yet, and no vertex
    //! is left with fewer than three edges (two on the boundary).
    [[nodiscard]] bool can_flip(Index edge) const;
    //! Flips an edge: it then joins the corners that were opposite to it.
    void flip(Index edge);

private:
    std::vector<Triangle> triangles_;
    std::vector<Index> edge_;                  // #H
    std::vector<std::array<Index, 2>> sides_;  // #E
    std::vector<Index> valence_;               // By vertex: number of edges.
    std::vector<bool> is_boundary_;            // By vertex.
    std::unordered_set<std::uint64_t> ends_;   // Of all edges.
};

}  // namespace remesh
