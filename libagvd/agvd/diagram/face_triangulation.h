//! \file
//! A face, cut into triangles at the points inside it.
#pragma once

#include <algorithm>

#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/surface.h"

namespace agvd {

//! Delaunay but for rounding: then a triangle reaches into few cells of the points.
class FaceTriangulation {
public:
    //! Begins with one triangle of the points 0, 1, 2: corners, counter-clockwise.
    void reset(const std::array<Vec2, 3>& corners) {
        points_.assign(corners.begin(), corners.end());
        pieces_.assign(1, {{0, 1, 2}, {no_index, no_index, no_index}});
    }

    //! Adds the next point, which lies inside. Cost: O(sqrt(n)) steps towards it, and a few flips.
    void add(const Vec2& p) {
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

    struct Piece {
        std::array<Index, 3> points;      //!< Counter-clockwise.
        std::array<Index, 3> neighbours;  //!< The piece across the side from point k to k + 1;
                                          //!< no_index: the side is one of the face.
    };
    [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }

private:
    static std::size_t next_of(std::size_t k) { return k == 2 ? 0 : k + 1; }
    static std::size_t previous_of(std::size_t k) { return k == 0 ? 2 : k - 1; }
    // Positive inside the circle through three points that lie counter-clockwise.
    static double inside_circle(const Vec2& p, const Vec2& q, const Vec2& r, const Vec2& at) {
        const Vec2 a = p - at;
        const Vec2 b = q - at;
        const Vec2 c = r - at;
        return a.squaredNorm() * cross(b, c) + b.squaredNorm() * cross(c, a) +
               c.squaredNorm() * cross(a, b);
    }

    // From piece to piece across sides that p lies behind; flat pieces could send it in circles.
    [[nodiscard]] Index find_holder(const Vec2& p) const {
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
        double best_margin = -infinity;
        for (Index i = 0; i < pieces_.size(); ++i) {
            const double least = std::min({margin(i, 0), margin(i, 1), margin(i, 2)});
            if (least > best_margin) {
                best_margin = least;
                piece = i;
            }
        }
        return piece;
    }

    [[nodiscard]] double doubled_area(Index a, Index b, Index c) const {
        return cross(points_[b] - points_[a], points_[c] - points_[a]);
    }

    void replace_neighbour(Index piece, Index old, Index now) {
        if (piece == no_index) return;
        for (Index& neighbour : pieces_[piece].neighbours) {
            if (neighbour == old) {
                neighbour = now;
                return;
            }
        }
    }

    // The new point is the last of its pieces; each flip gives it a neighbour, so they end.
    void flip_opposite(Index here) {
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

    std::vector<Vec2> points_;
    std::vector<Piece> pieces_;
    std::vector<Index> unchecked_;  // Pieces whose side opposite the new point may be flipped.
};

}  // namespace agvd
