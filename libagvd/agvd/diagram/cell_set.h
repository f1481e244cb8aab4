//! \file
//! Some of the cells of a diagram.
#pragma once

#include <cstdint>
#include <vector>

#include "agvd/core/types.h"

namespace agvd {

//! A bit for each site; no_index is in no set.
class CellSet {
public:
    //! Empty.
    explicit CellSet(Index num_sites = 0) : has_(num_sites, 0) {}
    //! Of so many sites; there are none of the new ones in it.
    void resize(Index num_sites) { has_.resize(num_sites, 0); }

    [[nodiscard]] Index num_sites() const { return static_cast<Index>(has_.size()); }
    [[nodiscard]] bool is_empty() const { return count_ == 0; }
    [[nodiscard]] bool has(Index site) const { return site != no_index && has_[site] != 0; }
    void set(Index site, bool has) {
        count_ += has ? 1 : 0;
        count_ -= has_[site];
        has_[site] = has ? 1 : 0;
    }
    void insert(Index site) {
        if (site != no_index) set(site, true);
    }
    void insert(const CellSet& other) {
        for (Index s = 0; s < other.num_sites(); ++s) {
            if (other.has(s)) insert(s);
        }
    }

private:
    std::vector<std::uint8_t> has_;
    Index count_ = 0;
};

}  // namespace agvd
