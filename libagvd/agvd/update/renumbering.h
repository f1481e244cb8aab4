//! \file
//! Sites get other numbers where some are removed.
#pragma once

#include <vector>

#include "agvd/core/types.h"

namespace agvd {

//! Old sites to new ones, in the same order; those that were removed, and no_index, to no_index.
class Renumbering {
public:
    //! \param removed  in any order.
    Renumbering(Index num_sites, const std::vector<Index>& removed) : new_site_(num_sites, 0) {
        for (const Index site : removed) new_site_[site] = no_index;
        for (Index& site : new_site_) {
            if (site != no_index) site = num_left_++;
        }
    }

    [[nodiscard]] Index num_old() const { return static_cast<Index>(new_site_.size()); }
    [[nodiscard]] Index num_left() const { return num_left_; }
    [[nodiscard]] Index operator()(Index site) const {
        return site == no_index ? no_index : new_site_[site];
    }

private:
    std::vector<Index> new_site_;
    Index num_left_ = 0;
};

}  // namespace agvd
