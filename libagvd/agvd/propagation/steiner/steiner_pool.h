//! \file
//! The memory of Steiner points: a block for each edge, which is taken when the front arrives and
//! given back when both faces are done.
#pragma once

#include <memory>
#include <vector>

#include "agvd/propagation/steiner/steiner_points.h"

namespace agvd {

//! Blocks of nodes, one for each live edge.
class SteinerPool {
public:
    SteinerPool(Index num_edges, const SteinerCounts& counts)
        : counts_(counts),
          chunk_shift_(static_cast<int>(std::bit_width(blocks_per_chunk * counts.most()))),
          first_(num_edges, never_used),
          free_(counts.most() + 1) {}

    [[nodiscard]] bool is_retired(Index edge) const { return first_[edge] == retired; }

    //! The nodes of a live edge, in the direction of its edge_half. They are made on first use. The
    //! edge must have points.
    [[nodiscard]] SteinerNode* nodes(Index edge) {
        if (first_[edge] == never_used) first_[edge] = take_block(counts_[edge]);
        return node_at(first_[edge]);
    }

    //! The same of an edge that has been used.
    [[nodiscard]] const SteinerNode* nodes(Index edge) const { return node_at(first_[edge]); }

    void retire(Index edge) {
        if (first_[edge] < retired) free_[counts_[edge]].push_back(first_[edge]);
        first_[edge] = retired;
    }

    //! Gives all memory back: every edge is retired.
    void clear() {
        std::fill(first_.begin(), first_.end(), retired);
        chunks_.clear();
    }

    [[nodiscard]] std::size_t peak_bytes() const {
        std::size_t free = free_.capacity() * sizeof(free_[0]);
        for (const auto& blocks : free_) free += blocks.capacity() * sizeof(Index);
        return first_.capacity() * sizeof(Index) + free +
               (chunks_.size() << chunk_shift_) * sizeof(SteinerNode);
    }

private:
    static constexpr Index never_used = no_index;
    static constexpr Index retired = no_index - 1;
    static constexpr Index blocks_per_chunk = 256;

    [[nodiscard]] SteinerNode* node_at(Index i) const {
        return chunks_[i >> chunk_shift_].get() + (i & ((Index{1} << chunk_shift_) - 1));
    }

    Index take_block(Index size) {
        if (std::vector<Index>& free = free_[size]; !free.empty()) {
            const Index first = free.back();
            free.pop_back();
            std::fill_n(node_at(first), size, SteinerNode{});
            return first;
        }
        const Index chunk_size = Index{1} << chunk_shift_;
        if (next_ + size > end_of_chunk_) {  // The rest of the chunk is smaller than a block.
            next_ = end_of_chunk_;
            end_of_chunk_ += chunk_size;
            chunks_.push_back(std::make_unique<SteinerNode[]>(chunk_size));
        }
        const Index first = next_;
        next_ += size;
        return first;
    }

    const SteinerCounts& counts_;
    int chunk_shift_;  // Chunks of 2^chunk_shift_ nodes.
    Index next_ = 0;   // Nodes used of all chunks, and their end.
    Index end_of_chunk_ = 0;
    std::vector<Index> first_;              // #E: the edge's first node.
    std::vector<std::vector<Index>> free_;  // By size of block.
    std::vector<std::unique_ptr<SteinerNode[]>> chunks_;
};

}  // namespace agvd
