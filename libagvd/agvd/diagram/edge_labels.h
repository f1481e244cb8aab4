//! \file
//! The labels on mesh vertices and edges. They are computed once for the faces on both sides, so
//! that these cannot disagree.
#pragma once

#include "agvd/core/reused_memory.h"
#include "agvd/core/types.h"
#include "agvd/propagation/relays.h"

namespace agvd {

//! A line on which labels change: a mesh edge, named by one of its half-edges, or a cut.
class LineId {
public:
    constexpr LineId() = default;
    [[nodiscard]] static constexpr LineId of_edge(Index half_edge) {
        return LineId(EitherIndex::first(half_edge));
    }
    [[nodiscard]] static constexpr LineId of_cut(Index cut) {
        return LineId(EitherIndex::second(cut));
    }

    [[nodiscard]] constexpr bool is_cut() const { return id_.is_second(); }
    [[nodiscard]] constexpr Index half_edge() const { return id_.first(); }
    [[nodiscard]] constexpr Index cut() const { return id_.second(); }

    friend constexpr bool operator==(const LineId&, const LineId&) = default;

private:
    explicit constexpr LineId(EitherIndex id) : id_(id) {}

    EitherIndex id_;
};

//! A change of label on a mesh edge or a cut.
struct Crossing {
    double at;        //!< In [0, 1] along the edge's edge_half, or along the cut.
    double distance;  //!< From both sites.
    Index site_before;
    Index site_after;
    LineId line;  //!< A mesh edge is known by its edge_half.

    friend bool operator==(const Crossing&, const Crossing&) = default;
};

//! A site inside a face that owns its place: a point of the complex like a mesh vertex.
struct InnerPoint {
    Index face;
    Vec2 position;  //!< In the face's own frame.
    Index site;     //!< no_index: the point was removed.
};

//! An end of a cut: a corner of the face, which may have the same vertex at several, or a point
//! inside.
struct CutEnd {
    Index point;
    Index corner;  //!< 0 to 2; 3: an inner point.
};

//! A straight line inside a face between two points, labelled like a mesh edge.
struct Cut {
    Index face;
    CutEnd from, to;
    Block row;  //!< Of EdgeLabels::crossings.
};

//! A face with inner points is cut into triangles at them, so that every cell in it reaches the
//! boundary of some triangle.
struct CutTriangle {
    std::array<CutEnd, 3> points;
    std::array<LineId, 3> sides;  //!< From point k to k + 1; a mesh edge by the face's half-edge.
};

//! What belongs to one face.
struct CutFace {
    Index face;
    Block inner_points, cuts, triangles;
};

//! Points are the mesh vertices, then the inner points. Crossings stand in rows, one for each edge
//! or cut; where a row is empty there is one label, that of both ends.
struct EdgeLabels {
    std::vector<Index> point_site;        //!< By point; no_index where no site reaches.
    std::vector<double> vertex_distance;  //!< #V.
    std::vector<Index> mixed_index;       //!< #F: position in mixed_faces; no_index: unlisted.

    std::vector<Block> edge_rows;  //!< #E.
    BlockPool<Crossing> crossings;

    BlockPool<InnerPoint> inner_points;
    BlockPool<Cut> cuts;
    BlockPool<CutTriangle> cut_triangles;
    std::vector<CutFace> cut_faces;  //!< By face.

    [[nodiscard]] std::span<const Crossing> on_edge(Index edge) const {
        return crossings[edge_rows[edge]];
    }
};

//! The positions in mixed_faces of those of these faces that are mixed.
[[nodiscard]] inline std::vector<Index> positions_of(const EdgeLabels& labels,
                                                     std::span<const Index> faces) {
    std::vector<Index> positions;
    for (const Index face : faces) {
        if (labels.mixed_index[face] != no_index) positions.push_back(labels.mixed_index[face]);
    }
    return positions;
}

//! \param corners  of the face, in its own frame.
[[nodiscard]] inline Vec2 position_of(const EdgeLabels& labels, const std::array<Vec2, 3>& corners,
                                      const CutEnd& end) {
    if (end.corner < 3) return corners[end.corner];
    const auto num_vertices = static_cast<Index>(labels.vertex_distance.size());
    return labels.inner_points[end.point - num_vertices].position;
}

}  // namespace agvd
