//! \file
//! Triangles whose edges can be flipped. Private to the dual.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>
#include <span>
#include <unordered_set>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/core/types.h"
#include "agvd/mesh/any_mesh.h"
#include "remesh/names.h"

namespace remesh {

//! Whether the flip of the edge between triangles (a, b, c) and (b, a, d) would make an edge there
//! sharper than 60 degrees and than all were before, or leave a triangle without area.
//! \param unit    unit(triangle): its unit normal, or zero.
//! \param beyond  beyond(i): that across side bc, ca, ad or db; unset: it does not count.
template <typename Unit, typename Beyond>
[[nodiscard]] bool flip_folds(const std::array<Index, 4>& corners, const Unit& unit,
                              const Beyond& beyond) {
    constexpr double gentle_fold = 0.5;  // Cosine.
    const auto& [a, b, c, d] = corners;
    const std::array<Vec3, 2> now{unit({a, b, c}), unit({b, a, d})};
    const std::array<Vec3, 2> then{unit({c, a, d}), unit({d, b, c})};
    if (then[0].isZero() || then[1].isZero()) return true;
    double before = now[0].dot(now[1]), after = then[0].dot(then[1]);
    for (std::size_t i = 0; i < 4; ++i) {
        const std::optional<Vec3> across = beyond(i);
        if (!across) continue;
        before = std::min(before, across->dot(now[i / 2]));
        after = std::min(after, across->dot(then[i == 0 || i == 3 ? 1 : 0]));
    }
    return !(after >= std::min(before, gentle_fold));
}

//! Half-edge 3 t + k runs from corner k to corner k + 1 of triangle t. Edges are numbered by their
//! two ends, ascending, and keep their number in a flip.
class FlippableMesh {
public:
    //! Accepts any triangles. Edges without exactly two sides in opposite directions never flip.
    explicit FlippableMesh(std::span<const Triangle> triangles, Ticker ticker = {})
        : triangles_(triangles.begin(), triangles.end()), edge_(3 * triangles.size()) {
        Index num_vertices = 0;
        for (const Triangle& t : triangles_) {
            num_vertices = std::max({num_vertices, t[0] + 1, t[1] + 1, t[2] + 1});
        }
        valence_.assign(num_vertices, 0);
        is_boundary_.assign(num_vertices, false);
        const std::vector<EdgeSide> sides = sorted_edge_sides(triangles_, ticker);
        ends_.reserve(sides.size() / 2);
        sides_.reserve(sides.size() / 2);
        for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
            ticker.tick();
            const bool is_inner = edge.size() == 2 && edge[0].forward != edge[1].forward;
            for (const EdgeSide& side : edge) edge_[side.half_edge] = num_edges();
            const bool is_swapped = is_inner && !edge[0].forward;
            sides_.push_back({edge[is_swapped ? 1 : 0].half_edge,
                              is_inner ? edge[is_swapped ? 0 : 1].half_edge : no_index});
            ends_.insert(edge[0].ends);
            for (const Index v : {edge[0].low(), edge[0].high()}) {
                ++valence_[v];
                if (!is_inner) is_boundary_[v] = true;
            }
        });
    }

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
    [[nodiscard]] bool can_flip(Index edge) const {
        if (!is_inner(edge)) return false;
        const auto& [h, g] = sides_[edge];
        for (const Index v : {tail(h), tail(g)}) {
            if (valence_[v] <= (is_boundary_[v] ? 2U : 3U)) return false;
        }
        const Index c = tail(previous(h)), d = tail(previous(g));
        return c != d && !ends_.contains(edge_key(c, d));
    }
    //! Flips an edge: it then joins the corners that were opposite to it.
    void flip(Index edge) {
        assert(can_flip(edge));
        const auto [h, g] = sides_[edge];
        const Index a = tail(h), b = tail(g), c = tail(previous(h)), d = tail(previous(g));
        const Index first = h / 3, second = g / 3;
        const std::array<Index, 4> old = {previous(h), next(g), previous(g), next(h)};
        const std::array<Index, 4> now = {3 * first, 3 * first + 1, 3 * second, 3 * second + 1};
        std::array<Index, 4> rim{};  // c to a, a to d, d to b, b to c.
        for (std::size_t i = 0; i < 4; ++i) rim[i] = edge_[old[i]];
        std::array<std::size_t, 4> slot{};  // Found before any side is overwritten.
        for (std::size_t i = 0; i < 4; ++i) slot[i] = sides_[rim[i]][0] == old[i] ? 0 : 1;
        triangles_[first] = {c, a, d};
        triangles_[second] = {d, b, c};
        for (std::size_t i = 0; i < 4; ++i) {
            edge_[now[i]] = rim[i];
            // An edge that never flips may have more sides than are kept.
            if (slot[i] == 0 || is_inner(rim[i])) sides_[rim[i]][slot[i]] = now[i];
        }
        edge_[3 * first + 2] = edge_[3 * second + 2] = edge;
        sides_[edge] = {3 * second + 2, 3 * first + 2};
        ends_.erase(edge_key(a, b));
        ends_.insert(edge_key(c, d));
        --valence_[a];
        --valence_[b];
        ++valence_[c];
        ++valence_[d];
    }

private:
    std::vector<Triangle> triangles_;
    std::vector<Index> edge_;                  // #H
    std::vector<std::array<Index, 2>> sides_;  // #E
    std::vector<Index> valence_;               // By vertex: number of edges.
    std::vector<bool> is_boundary_;            // By vertex.
    std::unordered_set<std::uint64_t> ends_;   // Of all edges.
};

}  // namespace remesh
