// Faces with the same three corners. Of those oriented alike one stays. If two of opposite
// orientation are left, they may be the walls of two bodies that touch: a wall is a set of such
// pairs, and its rim tells. Where bodies touch, an edge of the rim has two faces of each body. An
// edge of a sheet drawn from both sides has the pair alone, and a wall repeated by mistake leaves
// an odd number.
#include <algorithm>
#include <tuple>

#include "agvd/core/union_find.h"
#include "remesh/clean/soup.h"

namespace remesh::detail {
namespace {

class DuplicateFaces {
public:
    DuplicateFaces(Soup& soup, std::span<const EdgeSide> sides)
        : soup_(soup), sides_(sides), is_dead_(soup.triangles.size(), false) {}

    bool drop() {
        for_each_edge(sides_, [&](std::span<const EdgeSide> edge) { compare(edge); });
        if (!opposite_.empty()) drop_opposite();
        const Index dropped = drop_faces(soup_, is_dead_);
        soup_.counts.duplicate_faces += dropped;
        return dropped > 0;
    }

private:
    // Such faces share each of their edges and have the same third corner there.
    void compare(std::span<const EdgeSide> edge) {
        soup_.ticker.tick(edge.size());
        const auto apex = [&](std::size_t i) { return soup_.apex(edge[i].half_edge); };
        // By far the most frequent cases.
        if (edge.size() < 2 || (edge.size() == 2 && apex(0) != apex(1))) return;
        sheets_.clear();
        for (const EdgeSide& side : edge) {
            sheets_.push_back({soup_.apex(side.half_edge), side.forward, side.face()});
        }
        std::sort(sheets_.begin(), sheets_.end());
        Sheet last = sheets_.front();
        for (const Sheet& sheet : std::span(sheets_).subspan(1)) {
            if (sheet.apex != last.apex) {
                last = sheet;
            } else if (sheet.forward == last.forward) {
                is_dead_[sheet.face] = true;
            } else {
                opposite_.resize(is_dead_.size(), no_index);
                opposite_[last.face] = sheet.face;
                opposite_[sheet.face] = last.face;
                last = sheet;
            }
        }
    }

    // Keeps the walls that most edges of their rim ask for.
    void drop_opposite() {
        UnionFind walls(is_dead_.size());
        std::vector<std::int64_t> votes(is_dead_.size(), 0);  // By face, then by wall.
        for_each_edge(sides_, [&](std::span<const EdgeSide> edge) {
            soup_.ticker.tick(edge.size());
            std::vector<Index> faces;
            for (const EdgeSide& side : edge) {
                if (!is_dead_[side.face()]) faces.push_back(side.face());
            }
            const auto is_paired = [&](Index f) { return opposite_[f] != no_index; };
            const bool is_on_rim = faces.size() != 4 || !std::ranges::all_of(faces, is_paired);
            const bool touches = faces.size() >= 4 && faces.size() % 2 == 0;
            for (const Index f : faces) {
                if (!is_on_rim) (void)walls.unite(f, faces.front());
                if (is_on_rim && is_paired(f)) votes[f] += touches ? 1 : -1;
            }
        });
        for (Index f = 0; f < is_dead_.size(); ++f) {
            if (!walls.is_root(f)) votes[walls.root(f)] += votes[f];
        }
        for (Index f = 0; f < is_dead_.size(); ++f) {
            soup_.ticker.tick();
            if (opposite_[f] == no_index || opposite_[f] > f) continue;
            is_dead_[f] = votes[walls.root(f)] <= 0;
            soup_.counts.touching_faces += is_dead_[f] ? 0 : 1;
        }
    }

    struct Sheet {
        Index apex;
        bool forward;
        Index face;

        [[nodiscard]] auto operator<=>(const Sheet&) const = default;
    };

    Soup& soup_;
    std::span<const EdgeSide> sides_;
    std::vector<bool> is_dead_;
    std::vector<Index> opposite_;  // #F: the other face of a pair; empty: there is none.
    std::vector<Sheet> sheets_;    // Of one edge.
};

}  // namespace

bool drop_duplicates(Soup& soup, std::span<const EdgeSide> sides) {
    return DuplicateFaces(soup, sides).drop();
}

}  // namespace remesh::detail
