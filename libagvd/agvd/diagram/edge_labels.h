//! \file
//! The labels on mesh vertices, on mesh edges, and on the cuts inside faces. They are computed once
//! for the faces or triangles on both sides, so that these cannot disagree.
#pragma once

#include <algorithm>

#include "agvd/core/types.h"
#include "agvd/mesh/surface.h"
#include "agvd/propagation/propagate.h"

namespace agvd {

//! Some consecutive elements of a list.
struct Block {
    Index begin = 0;
    Index count = 0;

    [[nodiscard]] Index end() const { return begin + count; }
};

template <typename T>
[[nodiscard]] std::span<const T> elements_of(const std::vector<T>& list, const Block& block) {
    return std::span(list).subspan(block.begin, block.count);
}

template <typename T>
[[nodiscard]] Index size_of(const std::vector<T>& list) {
    return static_cast<Index>(list.size());
}

//! Appends to a list that is large when it is complete: where it has to grow it gets little room to
//! spare.
template <typename T>
void append_to(std::vector<T>& list, std::span<const T> more) {
    const std::size_t needed = list.size() + more.size();
    if (needed > list.capacity()) list.reserve(std::max(needed, list.size() + list.size() / 8));
    list.insert(list.end(), more.begin(), more.end());
}

//! A line on which labels change: a mesh edge, named by one of its half-edges, or a cut.
struct LineId {
    EitherIndex id;

    [[nodiscard]] static constexpr LineId of_edge(Index half_edge) {
        return {EitherIndex::first(half_edge)};
    }
    [[nodiscard]] static constexpr LineId of_cut(Index cut) { return {EitherIndex::second(cut)}; }

    [[nodiscard]] constexpr bool is_cut() const { return id.is_second(); }
    [[nodiscard]] constexpr Index half_edge() const { return id.first(); }
    [[nodiscard]] constexpr Index cut() const { return id.second(); }
};

//! Place and distance of a change of label on an edge that is the only one there for certain, where
//! label_edges() need not find it.
inline constexpr double guessed = -1;

//! A change of label on a mesh edge or a cut.
struct Crossing {
    double at;        //!< In [0, 1] along the edge's edge_half, or along the cut.
    double distance;  //!< From both sites.
    Index site_before;
    Index site_after;
    LineId line;  //!< A mesh edge is known by its edge_half.
};

//! A site inside a face that owns its position: a point of the complex like a mesh vertex.
struct InnerPoint {
    Vec2 position;  //!< In the face's own frame.
    Index site;
};

//! A corner of the face, which may have the same vertex at several, or a point inside.
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

//! Of a face that is cut at its inner points: every cell in it reaches some boundary.
struct CutTriangle {
    std::array<CutEnd, 3> points;
    std::array<LineId, 3> sides;  //!< From point k to k + 1; a mesh edge by the face's half-edge.
};

struct CutFace {
    Index face;
    Block triangles;
};

//! Points are the mesh vertices, then the inner points. Crossings stand in rows, one for each edge
//! or cut. Stretches of one label are nodes of a graph: one that ends at a point is that point;
//! then come the others, by the crossing that they follow along the edge_half or cut.
struct EdgeLabels {
    //! Points have lower numbers as nodes, crossings come behind.
    Index first_crossing_node = 0;
    std::vector<Index> point_site;        //!< By point; no_index where no site reaches.
    std::vector<double> vertex_distance;  //!< #V.
    std::vector<Index> mixed_index;       //!< #F: position in mixed_faces; no_index: unlisted.

    std::vector<Block> edge_rows;     //!< #E.
    std::vector<Crossing> crossings;  //!< Some may be in no row any more.

    std::vector<InnerPoint> inner_points;
    std::vector<Cut> cuts;
    std::vector<CutTriangle> cut_triangles;
    std::vector<CutFace> cut_faces;  //!< Ascending by face.

    [[nodiscard]] std::span<const Crossing> on_edge(Index edge) const {
        return elements_of(crossings, edge_rows[edge]);
    }
    [[nodiscard]] Index node_after(Index crossing) const { return first_crossing_node + crossing; }
    [[nodiscard]] std::size_t num_nodes() const { return first_crossing_node + crossings.size(); }
    //! \param corners  of the face, in its own frame.
    [[nodiscard]] Vec2 position_of(const CutEnd& end, const std::array<Vec2, 3>& corners) const {
        return end.corner < 3 ? corners[end.corner]
                              : inner_points[end.point - vertex_distance.size()].position;
    }
};

//! The triangles of a face; none if it is not cut.
[[nodiscard]] inline std::span<const CutTriangle> cut_triangles_of(const EdgeLabels& labels,
                                                                   Index face) {
    const auto found =
        std::lower_bound(labels.cut_faces.begin(), labels.cut_faces.end(), face,
                         [](const CutFace& cut, Index wanted) { return cut.face < wanted; });
    if (found == labels.cut_faces.end() || found->face != face) return {};
    return elements_of(labels.cut_triangles, found->triangles);
}

//! The label changes along one side of a triangle.
struct SideRow {
    Block row;
    bool forward;  //!< Whether they run counter-clockwise around the triangle.
};

[[nodiscard]] inline SideRow row_along(const Surface& surface, const EdgeLabels& labels,
                                       Index half_edge) {
    const Index edge = surface.edge[half_edge];
    return {labels.edge_rows[edge], surface.edge_half[edge] == half_edge};
}

//! \param k  the side from point k of the triangle to the next one.
[[nodiscard]] inline SideRow row_along(const Surface& surface, const EdgeLabels& labels,
                                       const CutTriangle& triangle, std::size_t k) {
    const LineId side = triangle.sides[k];
    if (!side.is_cut()) return row_along(surface, labels, side.half_edge());
    const Cut& cut = labels.cuts[side.cut()];
    return {cut.row, cut.from.point == triangle.points[k].point};
}

//! Calls callback(crossing, before, site_before, after, site_after) for each crossing of a row with
//! the nodes on its two sides.
//! \param from, to  the points at the row's ends.
template <typename Callback>
void for_each_crossing(const EdgeLabels& labels, const Block& row, Index from, Index to,
                       const Callback& callback) {
    Index before = from;
    for (Index c = row.begin; c < row.end(); ++c) {
        const Index after = c + 1 == row.end() ? to : labels.node_after(c);
        const Crossing& crossing = labels.crossings[c];
        callback(c, before, crossing.site_before, after, crossing.site_after);
        before = after;
    }
}

}  // namespace agvd
