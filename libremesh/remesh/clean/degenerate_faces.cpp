// Removes degenerate faces: their area is zero in double, as their corners lie on one line. Such a
// face fills the slit between its longest edge and its two other edges. Flipping the longest edge
// splits the neighbour across it at the third corner instead, so that no hole is left.
#include <algorithm>
#include <deque>
#include <limits>

#include "agvd/mesh/any_mesh.h"
#include "remesh/clean/soup.h"

namespace remesh::detail {
namespace {

// Most flips per degenerate face before the rest is dropped. Usually one is enough; a chain takes a
// few.
constexpr std::size_t most_flips = 32;

bool is_degenerate(const std::vector<Vec3>& positions, const Triangle& t) {
    return smallest_doubled_area(positions, t) == 0;
}

double length_sq(const Soup& soup, Index a, Index b) {
    return (soup.positions[a] - soup.positions[b]).squaredNorm();
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
    soup.triangles[f] = {a, d, c};
    soup.triangles[g] = {d, b, c};
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

class DegenerateFaces {
public:
    DegenerateFaces(Soup& soup, std::vector<Index>& twin)
        : soup_(soup), twin_(twin), is_degenerate_(soup.triangles.size()) {
        for (Index f = 0; f < is_degenerate_.size(); ++f) {
            soup.ticker.tick();
            is_degenerate_[f] = smallest_doubled_area(soup.positions, soup.triangles[f]) == 0;
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
        drop_rest();
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
        if (c == d || are_joined(soup_.triangles, twin_, Surface::previous(h), d)) return false;
        const std::array<bool, 2> degenerate{is_degenerate(soup_.positions, {a, d, c}),
                                             is_degenerate(soup_.positions, {d, b, c})};
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

    void drop_rest() {
        Index dropped = 0;
        for (const bool degenerate : is_degenerate_) dropped += degenerate ? 1 : 0;
        if (dropped == 0) return;
        soup_.counts.degenerate_faces += dropped;
        erase_faces(soup_, is_degenerate_, twin_);
    }

    Soup& soup_;
    std::vector<Index>& twin_;
    std::vector<bool> is_degenerate_;
    std::deque<Index> waiting_;
};

}  // namespace

double smallest_doubled_area(std::span<const Vec3> positions, const Triangle& t) {
    double smallest = std::numeric_limits<double>::infinity();
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
