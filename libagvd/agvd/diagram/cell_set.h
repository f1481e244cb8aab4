//! \file
//! Some of the cells of a diagram.
#pragma once

#include "agvd/diagram/arc_store.h"

namespace agvd {

//! A bit for each site; no_index is in no set.
class CellSet {
public:
    //! Empty.
    explicit CellSet(Index num_sites) : has_(num_sites, 0) {}

    [[nodiscard]] bool is_empty() const { return is_empty_; }
    [[nodiscard]] bool has(Index site) const { return site != no_index && has_[site] != 0; }
    void insert(Index site) {
        if (site == no_index) return;
        has_[site] = 1;
        is_empty_ = false;
    }

private:
    std::vector<std::uint8_t> has_;
    bool is_empty_ = true;
};

//! The faces that any of the cells reaches into, as far as they hang together with one of the seeds.
//! Ascending. Cost: O(seeds + faces), and a pass over #F bytes.
[[nodiscard]] std::vector<Index> faces_of_cells(const Surface& surface, const EdgeLabels& labels,
                                                const ArcStore& arcs, const CellSet& cells,
                                                std::span<const Index> seeds);

}  // namespace agvd
