//! \file
//! Gives equal points one index. Private to the STL reader.
#pragma once

#include <vector>

#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh {

class PointWelder {
public:
    //! The index of the first point with exactly these coordinates; a new one if there is none.
    //! \param p  finite; -0 equals 0. Cost: O(1) expected.
    Index index_of(const Vec3& p);

    //! Indexed by index_of, in the order of first arrival.
    [[nodiscard]] std::vector<Vec3>& points() { return points_; }

private:
    void grow();

    std::vector<Vec3> points_;
    std::vector<Index> slots_;  // Open addressing, 2^k slots, at most half of them taken.
};

}  // namespace remesh
