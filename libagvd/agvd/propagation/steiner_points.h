//! \file
//! The nodes of the Steiner graph: vertices and m points on each edge. Points live in blocks of one
//! edge each, taken from a pool when the front arrives and given back when both faces are done.
#pragma once

#include <bit>
#include <limits>
#include <memory>
#include <vector>

#include "agvd/mesh/surface.h"

namespace agvd {

//! The state of one node; the fields are read together, so they share one 24-byte record.
struct SteinerNode {
    double distance = std::numeric_limits<double>::infinity();
    Index site = no_index;
    //! The half-edge, in the face that the path came through, on which the node lies (a vertex: at
    //! whose tail it lies); no_index for a vertex that is a site.
    Index from = no_index;
    //! Where the path's previous node lies on the boundary of that face: see FaceRing.
    std::uint16_t parent_slot = 0;
    Index queued_in = no_index;  //!< The queue's memory; settled once served.

    static constexpr Index settled = no_index - 1;
    [[nodiscard]] bool is_settled() const { return queued_in == settled; }
};
static_assert(sizeof(SteinerNode) == 24);

//! Nodes are numbered vertices first, then edges in steps of 2^shift >= m, so that a node's edge is
//! a shift and not a division.
[[nodiscard]] constexpr int edge_shift(Index points_per_edge) {
    return static_cast<int>(std::bit_width(points_per_edge > 0 ? points_per_edge - 1 : 0u));
}

//! The nodes on a face's boundary, numbered counter-clockwise from the tail of one of its
//! half-edges h: a slot is a side (0: h, 1: next, 2: previous) and the number j of the node on it;
//! j = 0 is the side's tail vertex, j in [1, m] a Steiner point.
class FaceRing {
public:
    static constexpr std::uint16_t site_slot = 0xffff;  //!< The path comes straight from its site.

    static constexpr Index slot(Index side, Index j) { return side << side_shift | j; }
    static constexpr Index side_of(Index slot) { return slot >> side_shift; }
    static constexpr Index number_of(Index slot) { return slot & ((Index{1} << side_shift) - 1); }

    FaceRing(const Surface& surface, Index half_edge, double inverse_step)
        : length_(surface.length_of(half_edge)),
          apex_(surface.apex[half_edge]),
          inverse_step_(inverse_step) {}

    //! Position of a slot in the frame of h.
    [[nodiscard]] Vec2 position(Index slot) const {
        const double t = number_of(slot) * inverse_step_;
        switch (side_of(slot)) {
            case 0:
                return {t * length_, 0};
            case 1:
                return {length_ + t * (apex_.x() - length_), t * apex_.y()};
            default:
                return (1 - t) * apex_;
        }
    }
    //! True for the nodes of h itself, both ends included.
    [[nodiscard]] static bool is_on_base(Index slot) {
        return side_of(slot) == 0 || slot == FaceRing::slot(1, 0);
    }

private:
    static constexpr Index side_shift = 12;  // m < 2^12.

    double length_;
    Vec2 apex_;
    double inverse_step_;  // 1 / (m + 1)
};

//! Blocks of m nodes, one per live edge.
class SteinerPool {
public:
    SteinerPool(Index num_edges, Index points_per_edge)
        : points_per_edge_(points_per_edge), block_(num_edges, never_used) {}

    [[nodiscard]] bool is_retired(Index edge) const { return block_[edge] == retired; }

    //! The m nodes of a live edge, in the direction of its edge_half; created on first use.
    [[nodiscard]] SteinerNode* nodes(Index edge) {
        if (block_[edge] == never_used) block_[edge] = take_block();
        return block_nodes(block_[edge]);
    }

    void retire(Index edge) {
        if (block_[edge] < retired) free_.push_back(block_[edge]);
        block_[edge] = retired;
    }

    [[nodiscard]] std::size_t peak_bytes() const {
        return block_.capacity() * sizeof(Index) + free_.capacity() * sizeof(Index) +
               chunks_.size() * blocks_per_chunk * points_per_edge_ * sizeof(SteinerNode);
    }
    [[nodiscard]] std::size_t blocks_taken() const { return blocks_taken_; }

private:
    static constexpr Index never_used = no_index;
    static constexpr Index retired = no_index - 1;
    static constexpr Index blocks_per_chunk = 256;

    [[nodiscard]] SteinerNode* block_nodes(Index block) {
        return chunks_[block / blocks_per_chunk].get() +
               static_cast<std::size_t>(block % blocks_per_chunk) * points_per_edge_;
    }

    Index take_block() {
        ++blocks_taken_;
        if (!free_.empty()) {
            const Index block = free_.back();
            free_.pop_back();
            std::fill_n(block_nodes(block), points_per_edge_, SteinerNode{});
            return block;
        }
        if (next_ % blocks_per_chunk == 0) {
            chunks_.push_back(std::make_unique<SteinerNode[]>(
                static_cast<std::size_t>(blocks_per_chunk) * points_per_edge_));
        }
        return next_++;
    }

    Index points_per_edge_;
    Index next_ = 0;
    std::size_t blocks_taken_ = 0;
    std::vector<Index> block_;  // #E
    std::vector<Index> free_;
    std::vector<std::unique_ptr<SteinerNode[]>> chunks_;
};

}  // namespace agvd
