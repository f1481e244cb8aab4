//! \file
//! A face, cut into triangles at the points inside it.
#pragma once

#include "agvd/mesh/surface.h"

namespace agvd {

//! Delaunay but for rounding: then a triangle reaches into few cells of the points, however many
//! there are.
class FaceTriangulation {
public:
    //! Begins with one triangle of the points 0, 1, 2.
    //! \param corners  counter-clockwise.
    void reset(const std::array<Vec2, 3>& corners);

    //! Adds the next point, which lies inside. Cost: O(sqrt(n)) steps towards it, from the point
    //! added last, and a few flips.
    void add(const Vec2& p);

    struct Piece {
        std::array<Index, 3> points;      //!< Counter-clockwise.
        std::array<Index, 3> neighbours;  //!< The piece across the side from point k to k + 1;
                                          //!< no_index: the side is one of the face.
    };
    [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }

private:
    [[nodiscard]] Index find_holder(const Vec2& p) const;
    [[nodiscard]] double doubled_area(Index a, Index b, Index c) const;
    void replace_neighbour(Index piece, Index old, Index now);
    void flip_opposite(Index here);

    std::vector<Vec2> points_;
    std::vector<Piece> pieces_;
    std::vector<Index> unchecked_;  // Pieces whose side opposite the new point may be flipped.
};

}  // namespace agvd
