// Rounds over the vertices that the last round has lowered. The result is the least sum over all
// paths, whatever the order.
#include "remesh/sizing/gradation.h"

#include <algorithm>

#include "remesh/sizing/vertex_lines.h"

namespace remesh {
namespace {

using agvd::Index;
using agvd::Surface;

class GrowthLimit {
public:
    GrowthLimit(const Surface& surface, std::span<const std::pair<Index, Index>> joined,
                double slope, std::span<double> length, agvd::Ticker& ticker)
        : surface_(surface),
          slope_(slope),
          length_(length),
          ticker_(ticker),
          waits_(length.size(), 0) {
        for (const auto& [a, b] : joined) {
            copies_.emplace_back(a, b);
            copies_.emplace_back(b, a);
        }
        std::sort(copies_.begin(), copies_.end());
    }

    void run() {
        for (const auto& [a, b] : copies_) lower(a, length_[b]);
        for (Index v = 0; v < length_.size(); ++v) {
            ticker_.tick(4);
            spread(v);
        }
        while (!lowered_.empty()) {
            now_.swap(lowered_);
            lowered_.clear();
            for (const Index v : now_) {
                ticker_.tick(4);
                waits_[v] = 0;
                spread(v);
            }
        }
    }

private:
    void lower(Index vertex, double length) {
        if (!(length < length_[vertex])) return;
        length_[vertex] = length;
        if (waits_[vertex] != 0) return;
        waits_[vertex] = 1;
        lowered_.push_back(vertex);
    }

    void spread(Index v) {
        const double length = length_[v];
        for (auto copy = std::lower_bound(copies_.begin(), copies_.end(), std::pair(v, Index{0}));
             copy != copies_.end() && copy->first == v; ++copy) {
            lower(copy->second, length);
        }
        for_each_line(surface_, v,
                      [&](Index other, double way) { lower(other, length + slope_ * way); });
    }

    const Surface& surface_;
    double slope_;
    std::span<double> length_;
    agvd::Ticker& ticker_;
    std::vector<std::uint8_t> waits_;              // #V: is in lowered_.
    std::vector<std::pair<Index, Index>> copies_;  // Both ways, sorted.
    std::vector<Index> lowered_, now_;
};

}  // namespace

void limit_growth(const Surface& surface, std::span<const std::pair<Index, Index>> joined,
                  double slope, std::span<double> length, agvd::Ticker& ticker) {
    GrowthLimit(surface, joined, slope, length, ticker).run();
}

}  // namespace remesh
