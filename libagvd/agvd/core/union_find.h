//! \file
//! Disjoint sets that are united.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "agvd/core/types.h"

namespace agvd {

//! Disjoint sets of 0 to n - 1. The root of a set is its lowest element.
class UnionFind {
public:
    explicit UnionFind(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), Index{0});
    }

    //! Adds elements, each a set of its own. \param count  at least as many as there are.
    void grow(std::size_t count) {
        const std::size_t before = parent_.size();
        parent_.resize(count);
        std::iota(parent_.begin() + static_cast<std::ptrdiff_t>(before), parent_.end(),
                  static_cast<Index>(before));
    }

    //! Cost: O(log n) amortized; paths are halved.
    [[nodiscard]] Index root(Index i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    //! The same without halving paths: threads may ask at once while nothing is united.
    [[nodiscard]] Index root(Index i) const {
        while (parent_[i] != i) i = parent_[i];
        return i;
    }
    [[nodiscard]] bool is_root(Index i) const { return parent_[i] == i; }
    //! \return false if both are in one set already.
    bool unite(Index a, Index b) {
        if (parent_[a] == parent_[b]) return false;
        a = root(a);
        b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
        return a != b;
    }

private:
    std::vector<Index> parent_;
};

}  // namespace agvd
