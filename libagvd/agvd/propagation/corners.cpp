#include "agvd/propagation/corners.h"

#include <numeric>

#include "agvd/core/parallel.h"

namespace agvd {

Corners::Corners(const Surface& surface, int num_threads, const Progress& progress)
    : num_half_edges_(surface.twin.size()),
      corners_(std::make_unique_for_overwrite<Corner[]>(num_half_edges_)) {
    Poller poller(progress);
    std::vector<double> sums(num_chunks(surface.num_faces(), pass_grain), 0);
    parallel_chunks(
        surface.num_faces(), pass_grain, num_threads,
        [&](Index chunk, Index begin, Index end) {
            for (Index h = 3 * begin; h < 3 * end; ++h) {
                const double length = surface.length_of(h);
                corners_[h] = {surface.apex[h] / length, length, surface.twin[h], surface.tail(h)};
                sums[chunk] += length;
            }
        },
        poller);
    const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
    mean_length_ = sum / static_cast<double>(std::max<std::size_t>(num_half_edges_, 1));
}

}  // namespace agvd
