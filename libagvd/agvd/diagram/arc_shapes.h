//! \file
//! The conics that the arcs of a diagram are made of.
#pragma once

#include "agvd/diagram/arcs.h"
#include "agvd/diagram/conic.h"
#include "agvd/diagram/diagram.h"

namespace agvd {

//! A part of an arc that is one conic, in the own frame of the arc's face.
struct ArcShape {
    ArcKind kind = ArcKind::Chord;
    Conic conic = {};  //!< The left site first.
    Vec2 begin{0, 0}, end{0, 0};
    //! Inner points of the polyline between these; `end` itself is the next one, or the arc's head.
    Index num_points = 0;
};

struct ArcShapes {
    std::vector<ArcShape> shapes;
    std::vector<Block> of_arc;  //!< By arc, from tail to head; empty: shapes are not wanted.
};

//! Where a node of an arc lies in the own frame of the arc's face.
//! \param is_across  as in Arc.
[[nodiscard]] inline Vec2 position_of(const Surface& surface, const EdgeLabels& labels,
                                      const Arcs& arcs, Index face, NodeId node, bool is_across) {
    if (node.is_voronoi_vertex()) return arcs.voronoi_vertices[node.voronoi_vertex()].position;
    const Crossing& crossing = labels.crossings[node.crossing()];
    const std::array<Vec2, 3> corners{Vec2(0, 0), Vec2(surface.length_of(3 * face), 0),
                                      surface.apex[3 * face]};
    if (crossing.line.is_cut()) {
        const Cut& cut = labels.cuts[crossing.line.cut()];
        return (1 - crossing.at) * labels.position_of(cut.from, corners) +
               crossing.at * labels.position_of(cut.to, corners);
    }
    const Index h = crossing.line.half_edge();
    const Index side = (is_across ? surface.twin[h] : h) % 3;
    const double at = is_across ? 1 - crossing.at : crossing.at;
    return (1 - at) * corners[side] + at * corners[(side + 1) % 3];
}

}  // namespace agvd
