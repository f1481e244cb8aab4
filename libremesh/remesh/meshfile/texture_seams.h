//! \file
//! Texture coordinates at the corners of faces, and the edges along which they disagree.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh {

//! Texture coordinates of a face's corners, in their order: u to the right, v upwards. A corner
//! without a value has NaN for both.
using CornerCoordinates = std::array<Vec2, 3>;

//! Corners without values.
[[nodiscard]] CornerCoordinates no_coordinates();

//! Whether all three corners have values.
[[nodiscard]] inline bool is_whole(const CornerCoordinates& corners) {
    return corners[0].allFinite() && corners[1].allFinite() && corners[2].allFinite();
}

//! Whether two corners at one point have the same coordinates.
class CornerAgreement {
public:
    //! Values that differ by less than this share of the range of all values are rounding.
    static constexpr double tolerance = 1e-6;

    //! \param values  outlive this.
    explicit CornerAgreement(std::span<const CornerCoordinates> values);

    //! \param f, i  a face and its corner; \param g, j  another one.
    [[nodiscard]] bool operator()(Index f, std::size_t i, Index g, std::size_t j) const {
        const Vec2 &a = values_[f][i], &b = values_[g][j];
        const bool is_a = a.allFinite(), is_b = b.allFinite();
        return is_a && is_b ? (a - b).cwiseAbs().maxCoeff() <= most_ : is_a == is_b;
    }

private:
    std::span<const CornerCoordinates> values_;
    double most_ = 0;
};

//! The edges where two faces have different coordinates at one of the ends, or where only one of
//! them has any. Vertices at the same position count as one, so that meshes that are split along
//! their seams have them too. For RemeshOptions::texture_seams.
//!
//! \param values  #F
//! \return pairs of vertices, those of the first face at the edge; each edge once.
//! \throw InvalidOption  there is not one value for each face.
//! Cost: O(#F log #F).
[[nodiscard]] std::vector<std::array<Index, 2>> find_texture_seams(
    const MeshView& mesh, std::span<const CornerCoordinates> values, Ticker ticker = {});

}  // namespace remesh
