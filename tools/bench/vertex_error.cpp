#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/exact.h"

namespace bench {

VertexError vertex_error(std::span<const double> ours, std::span<const double> exact) {
    VertexError error{.lowest = std::numeric_limits<double>::infinity()};
    double count = 0;
    for (std::size_t v = 0; v < ours.size(); ++v) {
        if (std::isinf(ours[v]) && std::isinf(exact[v])) continue;
        const double excess = ours[v] == exact[v] ? 0 : ours[v] / exact[v] - 1;
        error.mean += excess;
        error.max = std::max(error.max, excess);
        error.lowest = std::min(error.lowest, excess);
        ++count;
    }
    if (count == 0) return {};
    error.mean /= count;
    return error;
}

}  // namespace bench
