//! \file
//! The graph on which upper bounds of distances are found.
#pragma once

#include <memory>
#include <vector>

#include "agvd/propagation/corners.h"

namespace agvd {

//! The arcs are the edges of a surface, and the straight lines between the apexes of two
//! neighbouring faces where these lines cross the shared edge. The arcs of a vertex are stored side
//! by side. Lengths are floats, rounded up by more than the rounding of any path along them.
struct ArcGraph {
    struct Arc {
        Index head;
        float length;
    };
    std::vector<Index> offsets;  //!< #V + 1
    std::vector<Index> ends;  //!< #V: the arcs of v are [offsets[v], ends[v]); the rest is empty.
    //! offsets.back() arcs; those of a vertex in any order. This is not a vector because a vector
    //! would write everything twice, the first time on one thread.
    std::unique_ptr<Arc[]> arcs;

    //! Cost: O(#H) time and space.
    ArcGraph(const Surface& surface, const Corners& corners, int num_threads,
             const Progress& progress = {});

    //! Starts to load the arcs of a vertex, which will be read soon.
    [[gnu::always_inline]] void prefetch(Index tail) const {
        __builtin_prefetch(arcs.get() + offsets[tail]);
        __builtin_prefetch(arcs.get() + offsets[tail] + 8);
    }
    [[nodiscard]] std::size_t bytes() const {
        return offsets.back() * sizeof(Arc) +
               (offsets.capacity() + ends.capacity()) * sizeof(Index);
    }
};

}  // namespace agvd
