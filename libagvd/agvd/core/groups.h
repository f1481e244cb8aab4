//! \file
//! Items in groups, by a counting sort. Private.
#pragma once

#include <numeric>
#include <span>
#include <vector>

#include "agvd/core/types.h"

namespace agvd {

class Groups {
public:
    //! \param for_each  for_each(add) calls add(group, item) for every item, the same in each call.
    //! Cost: O(num_groups + #items).
    template <typename ForEach>
    Groups(std::size_t num_groups, const ForEach& for_each) : begin_(num_groups + 1, 0) {
        for_each([&](Index group, Index) { ++begin_[std::size_t{group} + 1]; });
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        items_.resize(begin_.back());
        std::vector<Index> next(begin_.begin(), begin_.end() - 1);
        for_each([&](Index group, Index item) { items_[next[group]++] = item; });
    }

    //! In the order in which they were added.
    [[nodiscard]] std::span<const Index> of(Index group) const {
        return std::span(items_).subspan(begin_[group],
                                         begin_[std::size_t{group} + 1] - begin_[group]);
    }

private:
    std::vector<Index> begin_;  // #groups + 1
    std::vector<Index> items_;
};

//! The triangles at each vertex, ascending; once for each corner there.
[[nodiscard]] inline Groups triangles_by_vertex(std::span<const Triangle> triangles,
                                                std::size_t num_vertices) {
    return Groups(num_vertices, [&](const auto& add) {
        for (Index i = 0; i < triangles.size(); ++i) {
            for (const Index v : triangles[i]) add(v, i);
        }
    });
}

}  // namespace agvd
