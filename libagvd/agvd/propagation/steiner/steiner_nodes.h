//! \file
//! The nodes of the Steiner graph ([meng2023] Sec. 4.1): vertices, and m evenly spaced points on
//! each edge, in a block of memory that is taken when the front arrives and given back behind it.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include "agvd/mesh/surface.h"

namespace agvd {

//! The state of one node: a record of 24 bytes, since its fields are read together.
struct SteinerNode {
    double distance = infinity;
    Index site = no_index;
    //! The half-edge, in the face that the path came through, on which the node lies (a vertex: at
    //! whose tail it lies); no_index for a vertex that is a site.
    Index from = no_index;
    //! The slot of the path's previous node on the boundary of that face: see FaceRing.
    std::uint16_t parent_slot = 0;
    Index queued_in = no_index;  //!< Used by the queue; `settled` once the node is served.

    static constexpr Index settled = no_index - 1;
    [[nodiscard]] bool is_settled() const { return queued_in == settled; }
};
static_assert(sizeof(SteinerNode) == 24);

inline constexpr int max_steiner_points = 1000;  //!< On an edge.

//! The number of Steiner points of each edge.
class SteinerCounts {
public:
    //! \param of_edge  #E
    explicit SteinerCounts(std::vector<std::uint16_t> of_edge)
        : of_edge_(std::move(of_edge)),
          most_(of_edge_.empty() ? 0 : *std::max_element(of_edge_.begin(), of_edge_.end())) {}

    [[nodiscard]] Index operator[](Index edge) const { return of_edge_[edge]; }
    //! The spacing of an edge's points as a share of its length: 1 / (m + 1).
    [[nodiscard]] double step(Index edge) const { return 1.0 / (of_edge_[edge] + 1); }
    [[nodiscard]] Index most() const { return most_; }
    [[nodiscard]] double total() const {
        return std::accumulate(of_edge_.begin(), of_edge_.end(), 0.0);
    }

private:
    std::vector<std::uint16_t> of_edge_;
    Index most_;
};

//! Numbers of nodes: vertices first, then the points of each edge in steps of 2^shift, at least the
//! most points of an edge. So the edge of a node is found by a shift, not by a division. Behind
//! them come numbers for sites that have not started.
class NodeNumbers {
public:
    NodeNumbers(const Surface& surface, Index most_points)
        : num_vertices_(surface.num_vertices()),
          shift_(shift_for(most_points)),
          num_nodes_(num_vertices_ + (surface.num_edges() << shift_)) {}

    //! All numbers are below no_index, and a few below it are free.
    [[nodiscard]] static bool suffice(const Surface& surface, Index most_points,
                                      std::size_t num_sites) {
        return static_cast<double>(surface.num_vertices()) + static_cast<double>(num_sites) +
                   std::ldexp(static_cast<double>(surface.num_edges()), shift_for(most_points)) <
               static_cast<double>(no_index);
    }

    [[nodiscard]] bool is_site(Index number) const { return number >= num_nodes_; }
    [[nodiscard]] Index of_site(Index site) const { return num_nodes_ + site; }
    [[nodiscard]] Index site(Index number) const { return number - num_nodes_; }

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
    Index num_nodes_;
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

//! Blocks of nodes, one for each live edge.
class SteinerPool {
public:
    SteinerPool(Index num_edges, const SteinerCounts& counts)
        : counts_(counts),
          chunk_shift_(static_cast<int>(std::bit_width(blocks_per_chunk * counts.most()))),
          first_(num_edges, never_used),
          free_(counts.most() + 1) {}

    [[nodiscard]] bool is_retired(Index edge) const { return first_[edge] == retired; }

    //! Of a live edge that has points, in the direction of its edge_half; made on first use.
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
        std::size_t free = free_.capacity() * sizeof(std::vector<Index>);
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

    // What is rare stays out of the loops that read nodes, so that nodes() can be inlined.
    [[gnu::noinline]] Index take_block(Index size) {
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
