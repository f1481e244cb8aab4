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
        Index next = 0;
        for (Index& site : new_site_) {
            if (site != no_index) site = next++;
        }
    }

    void apply(Index& site) const {
        if (site != no_index) site = new_site_[site];
    }
    //! To the elements of an array by site.
    template <typename T>
    void apply_to_places(std::vector<T>& by_site) const {
        Index count = 0;
        for (Index s = 0; s < by_site.size(); ++s) {
            if (new_site_[s] != no_index) by_site[count++] = by_site[s];
        }
        by_site.resize(count);
    }

private:
    std::vector<Index> new_site_;
};

}  // namespace agvd
