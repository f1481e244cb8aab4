// Dijkstra's algorithm with all vertices as sources: the shortest lengths spread first.
#include "remesh/sizing/gradation.h"

#include <algorithm>
#include <functional>
#include <queue>

namespace remesh {
namespace {

using agvd::Index;
using agvd::Surface;

class GrowthLimit {
public:
    GrowthLimit(const Surface& surface, std::span<const std::pair<Index, Index>> joined,
                double slope, std::span<double> length, agvd::Ticker& ticker)
        : surface_(surface), slope_(slope), length_(length), ticker_(ticker) {
        for (const auto& [a, b] : joined) {
            copies_.emplace_back(a, b);
            copies_.emplace_back(b, a);
        }
        std::sort(copies_.begin(), copies_.end());
    }

    void run() {
        for (const auto& [a, b] : copies_) lower(a, length_[b]);
        for (Index h = 0; h < surface_.twin.size(); ++h) {
            ticker_.tick();
            const Index a = surface_.tail(h), b = surface_.head(h);
            const double rise = slope_ * surface_.length_of(h);
            lower(b, length_[a] + rise);
            lower(a, length_[b] + rise);
        }
        while (!queue_.empty()) {
            const auto [length, v] = queue_.top();
            queue_.pop();
            ticker_.tick(4);
            if (length_[v] == length) spread(v);
        }
    }

private:
    void lower(Index vertex, double length) {
        if (!(length < length_[vertex])) return;
        length_[vertex] = length;
        queue_.emplace(length, vertex);
    }

    void spread(Index v) {
        const double length = length_[v];
        for (auto copy = std::lower_bound(copies_.begin(), copies_.end(), std::pair(v, Index{0}));
             copy != copies_.end() && copy->first == v; ++copy) {
            lower(copy->second, length);
        }
        const Index first = surface_.outgoing[v];
        if (first == agvd::no_index) return;
        Index h = first;
        do {
            lower(surface_.head(h), length + slope_ * surface_.length_of(h));
            const Index in = Surface::previous(h);
            if (surface_.twin[in] == agvd::no_index) {
                lower(surface_.tail(in), length + slope_ * surface_.length_of(in));
                return;
            }
            h = surface_.twin[in];
        } while (h != first);
    }

    using Entry = std::pair<double, Index>;

    const Surface& surface_;
    double slope_;
    std::span<double> length_;
    agvd::Ticker& ticker_;
    std::vector<std::pair<Index, Index>> copies_;  // Both ways, sorted.
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

void limit_growth(const Surface& surface, std::span<const std::pair<Index, Index>> joined,
                  double slope, std::span<double> length, agvd::Ticker& ticker) {
    GrowthLimit(surface, joined, slope, length, ticker).run();
}

}  // namespace remesh
