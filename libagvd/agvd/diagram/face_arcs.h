//! \file
//! Second half of the diagram: the arcs inside the mixed faces, between the label changes on edges.
#pragma once

#include "agvd/diagram/apollonius.h"
#include "agvd/diagram/edge_labels.h"
#include "agvd/propagation/site_placement.h"

namespace agvd {

//! A label change inside a face, on a cut from a corner to a site (or between two sites): an arc
//! ends here and another goes on.
struct InnerCrossing {
    Vec2 position;
    double distance;
};

//! What the faces of one chunk contribute. Nodes are numbered: crossings on mesh edges first (their
//! index in EdgeLabels), then inner crossings from `inner_base`, then branches from `branch_base`;
//! inner crossings and branches are counted within the chunk.
struct FaceArcs {
    static constexpr Index inner_base = Index{1} << 30;
    static constexpr Index branch_base = Index{1} << 31;

    LocalDiagram local;               //!< Positions in the own frame of the face concerned.
    std::vector<Index> arc_face;      //!< #arcs.
    std::vector<Index> branch_face;   //!< #branches.
    std::vector<InnerCrossing> inner;
    std::vector<Index> inner_face;    //!< #inner.

    //! What a face adds to a cell: its area there, and pieces - cuts + sites inside (the face's part
    //! of the cell's Euler characteristic).
    struct CellPart {
        Index site;
        int euler;
        double area;
    };
    std::vector<CellPart> parts;
};

//! The faces [begin, end) of propagation.mixed_faces. A face with sites inside is cut into
//! triangles at them, so that every cell reaches the boundary of some triangle.
[[nodiscard]] FaceArcs trace_faces(const Surface& surface, const Propagation& propagation,
                                   const SitePlacement& placement, const EdgeLabels& labels,
                                   double chord_tolerance, Index begin, Index end);

}  // namespace agvd
