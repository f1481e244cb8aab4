//! \file
//! The faces around a vertex, laid out in one plane, and how they merge without it. Private to
//! intrinsic.
#pragma once

#include <array>
#include <vector>

#include "agvd/intrinsic/face_charts.h"

namespace agvd::detail {

//! Around an inner vertex, counter-clockwise.
struct VertexRing {
    std::vector<Index> half_edge;  //!< Those that leave the vertex, one for each face.
    std::vector<Vec2> spoke;       //!< The same edges, in the chart of the first face.
    std::vector<Vec2> turn;        //!< Of each face's chart into that of the first.
    bool is_simple = true;         //!< No face comes twice, and no edge comes back.
};

//! \param ring  is overwritten; its memory is used again.
void lay_ring(const Surface& surface, FaceCharts& charts, Index vertex, VertexRing& ring);

//! A ring of four with the second face first.
void rotate_ring(VertexRing& ring);

//! A face (a, b, c) that two or three faces at a vertex m became.
struct MergedFace {
    Index face = no_index;
    //! Sides ab, bc and ca in the faces that were; no_index where m lies on it.
    std::array<Index, 3> half_edge{no_index, no_index, no_index};
    std::array<double, 3> shares{};  //!< m = shares[0] a + shares[1] b + shares[2] c.
};

//! Three faces become one; of four, whose first and third edge are one straight line, two on each
//! side of it do. The vertex, other faces and edges leave gaps.
//! \param ring  simple, of a vertex without curvature.
//! \return without a face at the end, if there is one only.
[[nodiscard]] std::array<MergedFace, 2> merge_ring(Surface& surface, FaceCharts& charts,
                                                   const VertexRing& ring);

}  // namespace agvd::detail
