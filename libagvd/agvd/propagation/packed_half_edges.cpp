#include "agvd/propagation/packed_half_edges.h"

#include "agvd/core/parallel.h"

namespace agvd {

std::vector<PackedHalfEdge> pack_half_edges(const Surface& surface, int num_threads) {
    std::vector<PackedHalfEdge> result(surface.twin.size());
    parallel_chunks(static_cast<Index>(result.size()), 1 << 14, num_threads,
                    [&](Index, Index begin, Index end) {
                        for (Index h = begin; h < end; ++h) {
                            result[h] = {surface.apex[h], surface.length_of(h), surface.twin[h],
                                         surface.tail(h)};
                        }
                    });
    return result;
}

}  // namespace agvd
