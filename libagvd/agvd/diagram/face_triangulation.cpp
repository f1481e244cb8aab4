#include "agvd/diagram/face_triangulation.h"

#include <algorithm>
#include <limits>

#include "agvd/diagram/face_relays.h"

namespace agvd {
namespace {

std::size_t next_of(std::size_t k) { return k == 2 ? 0 : k + 1; }
std::size_t previous_of(std::size_t k) { return k == 0 ? 2 : k - 1; }

// Positive inside the circle through three points that lie counter-clockwise.
double inside_circle(const Vec2& p, const Vec2& q, const Vec2& r, const Vec2& at) {
    const Vec2 a = p - at;
    const Vec2 b = q - at;
    const Vec2 c = r - at;
    return a.squaredNorm() * cross(b, c) + b.squaredNorm() * cross(c, a) +
           c.squaredNorm() * cross(a, b);
}

}  // namespace

void FaceTriangulation::reset(const std::array<Vec2, 3>& corners) {
    points_.assign(corners.begin(), corners.end());
    pieces_.assign(1, {{0, 1, 2}, {no_index, no_index, no_index}});
}

double FaceTriangulation::doubled_area(Index a, Index b, Index c) const {
    return cross(points_[b] - points_[a], points_[c] - points_[a]);
}

// From piece to piece across sides that p lies behind; pieces that rounding made flat could send
// the walk round in circles.
Index FaceTriangulation::find_holder(const Vec2& p) const {
    const auto margin = [&](Index piece, std::size_t k) {
        const Vec2& from = points_[pieces_[piece].points[k]];
        const Vec2& to = points_[pieces_[piece].points[next_of(k)]];
        return cross(to - from, p - from);
    };
    auto piece = static_cast<Index>(pieces_.size()) - 1;
    for (std::size_t steps = 0; steps < pieces_.size(); ++steps) {
        Index across = no_index;
        for (std::size_t k = 0; k < 3 && across == no_index; ++k) {
            if (margin(piece, k) < 0) across = pieces_[piece].neighbours[k];
        }
        if (across == no_index) return piece;
        piece = across;
    }
    double best_margin = -std::numeric_limits<double>::infinity();
    for (Index i = 0; i < pieces_.size(); ++i) {
        const double least = std::min({margin(i, 0), margin(i, 1), margin(i, 2)});
        if (least > best_margin) {
            best_margin = least;
            piece = i;
        }
    }
    return piece;
}

void FaceTriangulation::replace_neighbour(Index piece, Index old, Index now) {
    if (piece == no_index) return;
    for (Index& neighbour : pieces_[piece].neighbours) {
        if (neighbour == old) {
            neighbour = now;
            return;
        }
    }
}

void FaceTriangulation::add(const Vec2& p) {
    const Index first = find_holder(p);
    const auto n = static_cast<Index>(points_.size());
    const auto second = static_cast<Index>(pieces_.size());
    const Index third = second + 1;
    points_.push_back(p);
    const Piece old = pieces_[first];
    pieces_[first] = {{old.points[0], old.points[1], n}, {old.neighbours[0], second, third}};
    pieces_.push_back({{old.points[1], old.points[2], n}, {old.neighbours[1], third, first}});
    pieces_.push_back({{old.points[2], old.points[0], n}, {old.neighbours[2], first, second}});
    replace_neighbour(old.neighbours[1], first, second);
    replace_neighbour(old.neighbours[2], first, third);
    unchecked_.assign({first, second, third});
    while (!unchecked_.empty()) {
        const Index piece = unchecked_.back();
        unchecked_.pop_back();
        flip_opposite(piece);
    }
}

// In pieces with the new point it is the last; flips give it another neighbour each, so they end.
void FaceTriangulation::flip_opposite(Index here) {
    const Piece mine = pieces_[here];
    const Index there = mine.neighbours[0];
    if (there == no_index) return;
    const Piece other = pieces_[there];
    std::size_t k = 0;  // Of the common side.
    while (other.points[k] != mine.points[1]) k = next_of(k);
    const auto [a, b, p] = mine.points;
    const Index q = other.points[previous_of(k)];
    if (!(inside_circle(points_[a], points_[b], points_[p], points_[q]) > 0)) return;
    // Nothing flat comes of it, let alone inside out.
    constexpr double least_share = 1e-9;
    const double at_a = doubled_area(p, a, q);
    const double at_b = doubled_area(q, b, p);
    if (!(std::min(at_a, at_b) > least_share * (at_a + at_b))) return;
    const Index across_a = other.neighbours[next_of(k)];
    const Index across_b = other.neighbours[previous_of(k)];
    pieces_[here] = {{a, q, p}, {across_a, there, mine.neighbours[2]}};
    pieces_[there] = {{q, b, p}, {across_b, mine.neighbours[1], here}};
    replace_neighbour(across_a, there, here);
    replace_neighbour(mine.neighbours[1], here, there);
    unchecked_.push_back(here);
    unchecked_.push_back(there);
}

}  // namespace agvd
