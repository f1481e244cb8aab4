#include "remesh/tiles/join_parts.h"

#include <map>
#include <numeric>
#include <utility>

#include "agvd/core/union_find.h"

namespace remesh {

std::vector<Index> join_parts(std::vector<double> area, std::span<const PartBorder> borders,
                              double least_area) {
    UnionFind joined(area.size());
    std::vector<Index> part(area.size());  // Of a root: the largest of its set.
    std::iota(part.begin(), part.end(), Index{0});
    while (true) {
        std::map<std::pair<Index, Index>, double> border;  // Small part, neighbour.
        for (const PartBorder& piece : borders) {
            const Index a = joined.root(piece.a), b = joined.root(piece.b);
            if (a == b) continue;
            for (const auto& [small, other] : {std::pair(a, b), std::pair(b, a)}) {
                const bool is_smaller =
                    area[small] < area[other] || (area[small] == area[other] && small > other);
                if (area[small] < least_area && is_smaller) border[{small, other}] += piece.length;
            }
        }
        if (border.empty()) break;
        std::map<Index, std::pair<double, Index>> longest;  // Of each small part: its neighbour.
        for (const auto& [parts, length] : border) {
            auto& best = longest.try_emplace(parts.first, 0.0, no_index).first->second;
            if (best.second == no_index || length > best.first) best = {length, parts.second};
        }
        // A part joins a larger one, so there are no circles.
        for (const auto& [small, best] : longest) {
            const Index from = joined.root(small), to = joined.root(best.second);
            const Index large = part[to];
            const double sum = area[from] + area[to];
            if (!joined.unite(from, to)) continue;
            area[joined.root(from)] = sum;
            part[joined.root(from)] = large;
        }
    }
    std::vector<Index> result;
    result.reserve(area.size());
    for (Index i = 0; i < area.size(); ++i) result.push_back(part[joined.root(i)]);
    return result;
}

}  // namespace remesh
