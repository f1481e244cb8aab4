//! \file
//! The nodes of the Steiner graph ([meng2023] Sec. 4.1): the vertices, and evenly spaced points on
//! each edge. Nodes are numbered by formula, vertices first; m points divide an edge into m + 1
//! equal parts. The number of points may differ from edge to edge.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "agvd/mesh/surface.h"

namespace agvd {

//! The state of one node: a record of 24 bytes, since its fields are read together.
struct SteinerNode {
    double distance = std::numeric_limits<double>::infinity();
    Index site = no_index;
    //! The half-edge, in the face that the path came through, on which the node lies (a vertex: at
    //! whose tail it lies); no_index for a vertex that is a site.
    Index from = no_index;
    //! The place of the path's previous node on the boundary of that face: see FaceRing.
    std::uint16_t parent_slot = 0;
    Index queued_in = no_index;  //!< Used by the queue; `settled` once the node is served.

    static constexpr Index settled = no_index - 1;
    [[nodiscard]] bool is_settled() const { return queued_in == settled; }
};
static_assert(sizeof(SteinerNode) == 24);

inline constexpr int max_steiner_points = 1000;  //!< On an edge.

//! The number of Steiner points of each edge: one number for all edges, or one for each.
class SteinerCounts {
public:
    explicit SteinerCounts(Index uniform)
        : uniform_(uniform), uniform_step_(1.0 / (uniform + 1)), most_(uniform) {}
    //! \param of_edge  #E
    explicit SteinerCounts(std::vector<std::uint16_t> of_edge)
        : of_edge_(std::move(of_edge)),
          most_(of_edge_.empty() ? 0 : *std::max_element(of_edge_.begin(), of_edge_.end())) {}

    [[nodiscard]] Index operator[](Index edge) const {
        return of_edge_.empty() ? uniform_ : of_edge_[edge];
    }
    //! The spacing of an edge's points as a share of its length: 1 / (m + 1).
    [[nodiscard]] double step(Index edge) const {
        return of_edge_.empty() ? uniform_step_ : 1.0 / (of_edge_[edge] + 1);
    }
    [[nodiscard]] Index most() const { return most_; }
    [[nodiscard]] double total(Index num_edges) const {
        if (of_edge_.empty()) return static_cast<double>(num_edges) * uniform_;
        return std::accumulate(of_edge_.begin(), of_edge_.end(), 0.0);
    }

private:
    std::vector<std::uint16_t> of_edge_;  // #E; empty: uniform.
    Index uniform_ = 0;
    double uniform_step_ = 1;
    Index most_;
};

//! Numbers of nodes: vertices first, then the points of each edge in steps of 2^shift, at least the
//! most points of an edge. So the edge of a node is found by a shift, not by a division.
class NodeNumbers {
public:
    NodeNumbers(const Surface& surface, Index most_points)
        : num_vertices_(surface.num_vertices()), shift_(shift_for(most_points)) {}

    //! All numbers are below no_index, and a few below it are free.
    [[nodiscard]] static bool suffice(const Surface& surface, Index most_points) {
        return static_cast<double>(surface.num_vertices()) +
                   std::ldexp(static_cast<double>(surface.num_edges()), shift_for(most_points)) <
               static_cast<double>(no_index);
    }

    [[nodiscard]] bool is_vertex(Index node) const { return node < num_vertices_; }
    [[nodiscard]] Index of_point(Index edge, Index point) const {
        return num_vertices_ + (edge << shift_) + point;
    }
    [[nodiscard]] Index edge(Index node) const { return (node - num_vertices_) >> shift_; }
    [[nodiscard]] Index point(Index node) const {
        return (node - num_vertices_) & ((Index{1} << shift_) - 1);
    }

private:
    [[nodiscard]] static int shift_for(Index most_points) {
        return static_cast<int>(std::bit_width(most_points > 0 ? most_points - 1 : 0u));
    }

    Index num_vertices_;
    int shift_;
};

//! The nodes on a face's boundary, numbered counter-clockwise from the tail of one of its
//! half-edges h: a slot is a side (0: h, 1: next, 2: previous) and the number j of the node on it;
//! j = 0 is the side's tail vertex, j in [1, m] a Steiner point.
class FaceRing {
public:
    static constexpr std::uint16_t site_slot = 0xffff;  //!< The path comes straight from its site.

    static constexpr Index slot(Index side, Index j) { return side << side_shift | j; }
    static constexpr Index side_of(Index slot) { return slot >> side_shift; }
    static constexpr Index number_of(Index slot) { return slot & ((Index{1} << side_shift) - 1); }

    //! The side of a slot other than site_slot.
    static constexpr Index half_edge(Index h, Index slot) {
        if (side_of(slot) == 0) return h;
        return side_of(slot) == 1 ? Surface::next(h) : Surface::previous(h);
    }
    //! Where a slot other than site_slot lies, in the frame of h.
    [[nodiscard]] static Vec2 position(const Surface& surface, const SteinerCounts& counts, Index h,
                                       Index slot) {
        const Index j = number_of(slot);
        const Vec2& apex = surface.apex[h];
        switch (side_of(slot)) {
            case 0: {
                const Index edge = surface.edge[h];
                return {j * counts.step(edge) * surface.length[edge], 0};
            }
            case 1: {
                const double t = j * counts.step(surface.edge[Surface::next(h)]);
                const double length = surface.length_of(h);
                return {length + t * (apex.x() - length), t * apex.y()};
            }
            default:
                return (1 - j * counts.step(surface.edge[Surface::previous(h)])) * apex;
        }
    }
    //! True for the nodes of h itself, both ends included.
    [[nodiscard]] static bool is_on_base(Index slot) {
        return side_of(slot) == 0 || slot == FaceRing::slot(1, 0);
    }

private:
    static constexpr Index side_shift = 12;  // m < 2^12.
};

}  // namespace agvd
