//! \file
//! First half of the diagram: the labels on mesh vertices and edges, computed once and shared by
//! the faces around them, so that neighbouring faces cannot disagree.
#pragma once

#include "agvd/diagram/relay_groups.h"

namespace agvd {

//! A change of label on a mesh edge or a cut.
struct Crossing {
    double at;        //!< In [0, 1] along the edge's edge_half, or along the cut.
    double distance;  //!< From both sites.
    Index site_before;
    Index site_after;
};

//! The crossings of one edge that has any: `count` of EdgeLabels::crossings from `begin`.
struct CrossingRow {
    Index edge;  //!< Mesh edge; first_cut + c: cut c.
    Index begin;
    Index count;

    static constexpr Index first_cut = Index{1} << 31;
};

//! A site inside a face that owns its place: a point of the complex like a mesh vertex.
struct InnerPoint {
    Index face;
    Vec2 position;  //!< In the face's own frame.
    Index site;
};

//! A straight line inside a face between two points, labelled like a mesh edge.
struct Cut {
    Index face;
    Index from, to;  //!< Points.
    Index row;       //!< no_index: one label.
};

//! A face with inner points is cut into triangles at them, so that every cell in it reaches the
//! boundary of some triangle.
struct CutTriangle {
    std::array<Index, 3> points;
    std::array<Index, 3> sides;  //!< From point k to k + 1: a half-edge, or first_cut + c.
};

struct CutFace {
    Index mixed_index;
    Index first_triangle, num_triangles;
};

//! Points are the mesh vertices, then the inner points. An edge that has no row has one label, that
//! of its ends.
struct EdgeLabels {
    std::vector<Index> point_site;        //!< By point; no_index where no site reaches.
    std::vector<double> vertex_distance;  //!< #V.
    std::vector<Index> mixed_index;       //!< #F: position in mixed_faces; no_index: unlisted.

    std::vector<Index> edge_row;  //!< #E; no_index: one label.
    std::vector<CrossingRow> rows;
    std::vector<Crossing> crossings;  //!< Row after row; may have gaps.

    std::vector<InnerPoint> inner_points;
    std::vector<Cut> cuts;
    std::vector<CutTriangle> cut_triangles;
    std::vector<CutFace> cut_faces;  //!< Ascending.

    [[nodiscard]] std::span<const Crossing> in_row(Index row) const {
        if (row == no_index) return {};
        return std::span(crossings).subspan(rows[row].begin, rows[row].count);
    }
    [[nodiscard]] std::span<const Crossing> on_edge(Index edge) const {
        return in_row(edge_row[edge]);
    }
};

class EarlierParts;

//! A vertex all of whose faces are listed takes the nearest site over the relays of those faces
//! (which may be nearer than the engine's graph knows); an edge all of whose faces are listed gets
//! the envelope of the relays of both sides and of its ends. No cuts yet.
//! Cost: O(relays) a listed face, O(relays) and a few square roots a crossing.
//! \param earlier  where it holds, its labels are taken over; may be null. Vertices are compared.
[[nodiscard]] EdgeLabels label_edges(const Surface& surface, const Propagation& propagation,
                                     const RelayGroups& groups, EarlierParts* earlier,
                                     int num_threads);

}  // namespace agvd
