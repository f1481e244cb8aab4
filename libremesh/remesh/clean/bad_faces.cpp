// Faces that are no part of a surface: copies of others, and faces without area.
#include <algorithm>
#include <deque>
#include <tuple>

#include "agvd/core/union_find.h"
#include "agvd/mesh/any_mesh.h"
#include "remesh/clean/coincident.h"
#include "remesh/clean/soup.h"

namespace remesh::detail {
namespace {

// Faces with the same three corners: of those oriented alike one stays. Two of opposite orientation
// may be the walls of two bodies that touch: then an edge of the rim of all such pairs has two
// faces of each body. At a sheet drawn from both sides it has the pair alone; a repeated wall
// leaves an odd number. Where some edges have the pair alone, and others the pair and a body that
// is closed without it, the pair is a flap that diagonals of polygons made: both go.
class DuplicateFaces {
public:
    DuplicateFaces(Soup& soup, std::span<const EdgeSide> sides)
        : soup_(soup),
          sides_(sides),
          is_dead_(soup.mesh.triangles.size(), false),
          walls_(is_dead_.size()),
          patch_(is_dead_.size(), no_index) {}

    bool drop() {
        for_each_edge(sides_, [&](std::span<const EdgeSide> edge) { compare(edge); });
        for (const CoincidentPatch& pair : find_coincident(soup_.mesh, sides_, soup_.ticker)) {
            compare(pair);
        }
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

    // Patches have other triangles than theirs.
    void compare(const CoincidentPatch& pair) {
        const auto is_done = [&](Index f) {
            return is_dead_[f] || (!opposite_.empty() && opposite_[f] != no_index);
        };
        if (std::ranges::any_of(pair.first, is_done) || std::ranges::any_of(pair.copy, is_done)) {
            return;
        }
        for (const Index f : pair.copy) is_dead_[f] = !pair.is_turned;
        if (!pair.is_turned) return;
        opposite_.resize(is_dead_.size(), no_index);
        for (const auto* patch : {&pair.first, &pair.copy}) {
            for (const Index f : *patch) {
                opposite_[f] = patch == &pair.first ? no_index - 1 : pair.first.front();
                patch_[f] = patch->front();
                (void)walls_.unite(f, pair.first.front());
            }
        }
    }

    // Keeps the walls that most edges of their rim ask for. Flaps have no vertex inside.
    void drop_opposite() {
        std::vector<std::int64_t> votes(is_dead_.size(), 0);  // By face, then by wall.
        enum Trait : unsigned { alone = 1, closed = 2, odd = 4, inner = 8 };
        std::vector<unsigned> traits(is_dead_.size(), 0);  // By face, then by wall.
        std::vector<bool> is_rim(soup_.mesh.positions.size(), false);
        for_each_edge(sides_, [&](std::span<const EdgeSide> edge) {
            soup_.ticker.tick(edge.size());
            std::vector<Index> faces;
            for (const EdgeSide& side : edge) {
                if (!is_dead_[side.face()]) faces.push_back(side.face());
            }
            const auto is_paired = [&](Index f) { return opposite_[f] != no_index; };
            const bool is_on_rim = faces.size() != 4 || !std::ranges::all_of(faces, is_paired);
            const bool is_in_patch = faces.size() == 2 && patch_[faces[0]] != no_index &&
                                     patch_[faces[0]] == patch_[faces[1]];
            if (is_in_patch) return;
            const bool touches = faces.size() >= 4 && faces.size() % 2 == 0;
            for (const Index f : faces) {
                if (!is_on_rim) (void)walls_.unite(f, faces.front());
                if (!is_on_rim || !is_paired(f)) continue;
                votes[f] += touches ? 1 : -1;
                traits[f] |= faces.size() == 2 ? alone : touches ? closed : odd;
                is_rim[edge[0].low()] = is_rim[edge[0].high()] = true;
            }
        });
        for (Index f = 0; f < is_dead_.size(); ++f) {
            const Index wall = walls_.root(f);
            if (wall != f) votes[wall] += votes[f];
            traits[wall] |= traits[f];
            for (const Index v : soup_.mesh.triangles[f]) {
                if (opposite_[f] != no_index && !is_rim[v]) traits[wall] |= inner;
            }
        }
        for (Index f = 0; f < is_dead_.size(); ++f) {
            soup_.ticker.tick();
            if (opposite_[f] == no_index) continue;
            const Index wall = walls_.root(f);
            const bool is_later = opposite_[f] < f, is_flap = traits[wall] == (alone | closed);
            is_dead_[f] = is_flap || (is_later && votes[wall] <= 0);
            soup_.counts.touching_faces += is_later && !is_dead_[f] ? 1 : 0;
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
    UnionFind walls_;
    std::vector<Index> patch_;     // #F: of a coincident patch, its lowest face.
    std::vector<Index> opposite_;  // #F: the other face of a pair; empty: there is none.
    std::vector<Sheet> sheets_;    // Of one edge.
};

// Most flips per degenerate face before the rest is dropped. Usually one is enough; a chain takes a
// few.
constexpr std::size_t most_flips = 32;

// Height of a sliver, in longest sides: positions that near to an edge are one with it, as for
// vertices of cracks.
constexpr double sliver_height = 1e-2;

bool is_degenerate(const std::vector<Vec3>& positions, const Triangle& t) {
    return smallest_doubled_area(positions, t) == 0;
}

double length_sq(const Soup& soup, Index a, Index b) {
    return (soup.mesh.positions[a] - soup.mesh.positions[b]).squaredNorm();
}

Index longest_side(const Soup& soup, Index face) {
    Index longest = 3 * face;
    for (Index h = longest + 1; h < 3 * face + 3; ++h) {
        if (length_sq(soup, soup.tail(h), soup.head(h)) >
            length_sq(soup, soup.tail(longest), soup.head(longest))) {
            longest = h;
        }
    }
    return longest;
}

// Faces (a, b, c) and (b, a, d) of the edge a-b at h and its twin become (a, d, c) and (d, b, c).
void flip(Soup& soup, std::vector<Index>& twin, Index h) {
    const Index o = twin[h], f = h / 3, g = o / 3;
    const Index a = soup.tail(h), b = soup.head(h), c = soup.apex(h), d = soup.apex(o);
    const std::array<Index, 4> rim{twin[Surface::next(o)], twin[Surface::previous(o)],
                                   twin[Surface::next(h)], twin[Surface::previous(h)]};
    soup.mesh.triangles[f] = {a, d, c};
    soup.mesh.triangles[g] = {d, b, c};
    const auto join = [&](Index side, Index across) {
        twin[side] = across;
        if (across != no_index) twin[across] = side;
    };
    join(3 * f, rim[0]);      // a-d
    join(3 * g, rim[1]);      // d-b
    join(3 * g + 1, rim[2]);  // b-c
    join(3 * f + 2, rim[3]);  // c-a
    join(3 * f + 1, 3 * g + 2);
}

// A face without area in double fills the slit between its longest edge and the two others.
// Flipping that edge splits the neighbour instead: no hole is left.
class DegenerateFaces {
public:
    DegenerateFaces(Soup& soup, std::vector<Index>& twin)
        : soup_(soup), twin_(twin), is_degenerate_(soup.mesh.triangles.size()) {
        for (Index f = 0; f < is_degenerate_.size(); ++f) {
            soup.ticker.tick();
            is_degenerate_[f] = is_degenerate(soup.mesh.positions, soup.mesh.triangles[f]);
            if (is_degenerate_[f]) waiting_.push_back(f);
        }
    }

    void remove() {
        if (waiting_.empty()) return;
        std::size_t flips_left = most_flips * waiting_.size();
        while (!waiting_.empty()) {
            const Index face = waiting_.front();
            waiting_.pop_front();
            if (flips_left > 0 && is_degenerate_[face] && try_flip(face)) --flips_left;
        }
        soup_.counts.degenerate_faces += drop_faces(soup_, is_degenerate_, &twin_);
    }

private:
    // A flip must leave fewer degenerate faces, or as many with a shorter edge, so that flips end.
    bool try_flip(Index face) {
        soup_.ticker.tick();
        const Index h = longest_side(soup_, face);
        const Index o = twin_[h];
        // Such a face on the boundary is dropped: it leaves no hole.
        if (o == no_index) return false;
        const Index other = o / 3;
        const Index a = soup_.tail(h), b = soup_.head(h), c = soup_.apex(h), d = soup_.apex(o);
        if (c == d || are_joined(soup_.mesh.triangles, twin_, Surface::previous(h), d))
            return false;
        const std::array<bool, 2> degenerate{is_degenerate(soup_.mesh.positions, {a, d, c}),
                                             is_degenerate(soup_.mesh.positions, {d, b, c})};
        const int before = is_degenerate_[other] ? 2 : 1;
        const int after = int{degenerate[0]} + int{degenerate[1]};
        if (after > before ||
            (after == before && !(length_sq(soup_, c, d) < length_sq(soup_, a, b)))) {
            return false;
        }
        flip(soup_, twin_, h);
        if (!is_degenerate_[other]) soup_.face_origin[face] = soup_.face_origin[other];
        is_degenerate_[face] = degenerate[0];
        is_degenerate_[other] = degenerate[1];
        if (after < before) soup_.counts.absorbed_faces += static_cast<Index>(before - after);
        for (const Index changed : {face, other}) {  // Their neighbours may be flipped now.
            if (is_degenerate_[changed]) waiting_.push_back(changed);
            for (Index side = 3 * changed; side < 3 * changed + 3; ++side) {
                const Index next_to = twin_[side] == no_index ? no_index : twin_[side] / 3;
                if (next_to != no_index && is_degenerate_[next_to]) waiting_.push_back(next_to);
            }
        }
        return true;
    }

    Soup& soup_;
    std::vector<Index>& twin_;
    std::vector<bool> is_degenerate_;
    std::deque<Index> waiting_;
};

}  // namespace

bool drop_duplicates(Soup& soup, std::span<const EdgeSide> sides) {
    return DuplicateFaces(soup, sides).drop();
}

bool drop_slivers(Soup& soup, std::span<const EdgeSide> sides) {
    const auto num_faces = static_cast<Index>(soup.mesh.triangles.size());
    std::vector<bool> is_sliver(num_faces, false), hangs = is_sliver, belongs = is_sliver;
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        if (edge.size() > 1) return;
        const Index f = edge[0].face(), h = longest_side(soup, f);
        is_sliver[f] = doubled_normal(soup.mesh.positions, soup.mesh.triangles[f]).norm() <=
                       sliver_height * length_sq(soup, soup.tail(h), soup.head(h));
    });
    UnionFind patches(num_faces);
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        soup.ticker.tick();
        const auto slivers = static_cast<std::size_t>(std::ranges::count_if(
            edge, [&](const EdgeSide& side) { return is_sliver[side.face()]; }));
        if (slivers == 0 || edge.size() < 2) return;
        const bool has_its_faces = edge.size() - slivers >= 2;
        if (slivers == 2 && edge.size() == 2) patches.unite(edge[0].face(), edge[1].face());
        for (const EdgeSide& side : edge) {
            if (has_its_faces) hangs[side.face()] = true;
            if (!has_its_faces && edge.size() != slivers) belongs[side.face()] = true;
        }
    });
    for (Index f = 0; f < num_faces; ++f) {
        const Index root = patches.root(f);
        hangs[root] = hangs[root] || hangs[f];
        belongs[root] = belongs[root] || belongs[f];
    }
    std::vector<bool> is_dead(num_faces, false);
    for (Index f = 0; f < num_faces; ++f) {
        const Index root = patches.root(f);
        is_dead[f] = is_sliver[f] && hangs[root] && !belongs[root];
    }
    const Index dropped = drop_faces(soup, is_dead);
    soup.counts.degenerate_faces += dropped;
    return dropped > 0;
}

double smallest_doubled_area(std::span<const Vec3> positions, const Triangle& t) {
    double smallest = infinity;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& origin = positions[t[k]];
        const Vec3 along = positions[t[(k + 1) % 3]] - origin;
        const Vec3 up = positions[t[(k + 2) % 3]] - origin;
        const double doubled_area = along.cross(up).norm();
        if (!std::isfinite(doubled_area)) return doubled_area;
        smallest = std::min(smallest, doubled_area);
    }
    return smallest;
}

void remove_degenerate_faces(Soup& soup, std::vector<Index>& twin) {
    DegenerateFaces(soup, twin).remove();
}

}  // namespace remesh::detail
