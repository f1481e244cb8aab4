#include "agvd/propagation/corners.h"

#include "agvd/core/parallel.h"

namespace agvd {

Corners::Corners(const Surface& surface, int num_threads)
    : num_half_edges_(surface.twin.size()),
      corners_(std::make_unique_for_overwrite<Corner[]>(num_half_edges_)) {
    constexpr Index grain = 1 << 14;  // Faces.
    parallel_chunks(surface.num_faces(), grain, num_threads, [&](Index, Index begin, Index end) {
        for (Index h = 3 * begin; h < 3 * end; ++h) {
            const double length = surface.length_of(h);
            corners_[h] = {surface.apex[h] / length, length, surface.twin[h], surface.tail(h)};
        }
    });
}

}  // namespace agvd
