// Rounds over the vertices that the last round has lowered. The result is the least sum over all
// paths, whatever the order.
#include "remesh/sites/gradation.h"

#include <algorithm>

#include "remesh/sites/vertex_lines.h"

namespace remesh {
namespace {

class GrowthLimit {
public:
    GrowthLimit(const Surface& surface, std::span<const std::pair<Index, Index>> joined,
                double slope, Paths paths, std::span<double> length, Ticker& ticker)
        : surface_(surface),
          slope_(slope),
          paths_(paths),
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
        if (paths_ == Paths::Edges) {
            for (Index e = 0; e < surface_.num_edges(); ++e) check_edge(e);
        } else {
            for (Index v = 0; v < length_.size(); ++v) spread(v);
        }
        while (!lowered_.empty()) {
            now_.swap(lowered_);
            lowered_.clear();
            for (const Index v : now_) {
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

    void check_edge(Index e) {
        ticker_.tick();
        const Index h = surface_.edge_half[e];
        const Index a = surface_.tail(h), b = surface_.head(h);
        const double rise = slope_ * surface_.length[e];
        lower(b, length_[a] + rise);
        lower(a, length_[b] + rise);
    }

    void spread(Index v) {
        ticker_.tick(4);
        const double length = length_[v];
        for (auto copy = std::lower_bound(copies_.begin(), copies_.end(), std::pair(v, Index{0}));
             copy != copies_.end() && copy->first == v; ++copy) {
            lower(copy->second, length);
        }
        const auto reach = [&](Index other, double way) { lower(other, length + slope_ * way); };
        if (paths_ == Paths::Edges) {
            for_each_edge(surface_, v, reach);
        } else {
            for_each_line(surface_, v, reach);
        }
    }

    const Surface& surface_;
    double slope_;
    Paths paths_;
    std::span<double> length_;
    Ticker& ticker_;
    std::vector<std::uint8_t> waits_;              // #V: is in lowered_.
    std::vector<std::pair<Index, Index>> copies_;  // Both ways, sorted.
    std::vector<Index> lowered_, now_;
};

}  // namespace

void limit_growth(const Surface& surface, std::span<const std::pair<Index, Index>> joined,
                  double slope, Paths paths, std::span<double> length, Ticker& ticker) {
    GrowthLimit(surface, joined, slope, paths, length, ticker).run();
}

}  // namespace remesh
