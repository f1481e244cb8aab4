//! \file
//! The label changes on the boundary of a triangle, and what the triangle adds to cells.
#pragma once

#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/face_arcs.h"

namespace agvd {

//! One side of a triangle.
struct TriangleSide {
    Vec2 from, to;
    Index to_point;
    Block row;
    bool forward;    //!< Whether the crossings of the row run from `from` to `to`.
    bool is_across;  //!< Not the half-edge of which the crossings are.
};

//! A crossing as met from the triangle: a face that is glued to itself meets one twice.
struct BoundaryNode {
    Index crossing;
    bool is_across;  //!< As in TriangleSide.
};

//! The nodes of the breakpoints are their places in this list until name_nodes().
struct TriangleBoundary {
    std::vector<Breakpoint> breakpoints;
    std::vector<BoundaryNode> nodes;  //!< By breakpoint.
};

//! Sums up what one triangle adds to cells: the elements of `parts` from `first` on.
struct TriangleParts {
    std::vector<FaceArcs::CellPart>& parts;
    std::size_t first;

    void add(Index site, int pieces, double area) {
        for (std::size_t i = first; i < parts.size(); ++i) {
            FaceArcs::CellPart& part = parts[i];
            if (part.site != site) continue;
            part.pieces += pieces;
            part.area += area;
            return;
        }
        parts.push_back({site, pieces, area});
    }
};

//! Replaces `boundary`, and adds what the boundary contributes to the areas by Green's theorem:
//! nothing if there is no breakpoint.
//! \param sides  counter-clockwise.
//! \param site   of the first side's first point.
void collect_breakpoints(const EdgeLabels& labels, const std::array<TriangleSide, 3>& sides,
                         Index site, TriangleBoundary& boundary, TriangleParts parts);

//! Adds what the arcs of the triangle contribute: to the areas, and to the number of pieces.
//! \param before  where the triangle's arcs and connections begin.
void count_arcs(const TriangleBoundary& boundary, const LocalDiagram& local,
                const LocalDiagram::Mark& before, TriangleParts parts);

//! Names the crossings at which arcs begin and end.
//! \param first_arc  of the triangle.
void name_nodes(const TriangleBoundary& boundary, Index first_arc, LocalDiagram& local);

}  // namespace agvd
