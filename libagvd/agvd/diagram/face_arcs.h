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
    Index
        site_after;  //!< Of the interval named after it; no_index when that is named after a point.
};

//! A site kept off the cuts inside a face (by position in mixed_faces), since its interval there
//! would not hang together with the rest of its cell.
struct BarredSite {
    Index mixed_index;
    Index site;
    [[nodiscard]] auto operator<=>(const BarredSite&) const = default;
};

//! Names of boundary intervals, for telling what hangs together: an interval that ends at a mesh
//! vertex or site is named after it, another after the crossing that it follows (along the
//! edge_half, or along the cut).
struct IntervalName {
    enum Kind : Index { Vertex, Crossing, Inner, Site };
    static constexpr Index make(Kind kind, Index index) { return Index{kind} << 30 | index; }
    static constexpr Kind kind(Index name) { return static_cast<Kind>(name >> 30); }
    static constexpr Index index(Index name) { return name & ((Index{1} << 30) - 1); }
};

//! What the faces of one chunk contribute. Nodes are numbered: crossings on mesh edges first (their
//! index in EdgeLabels), then inner crossings from `inner_base`, then branches from `branch_base`;
//! inner crossings and branches are counted within the chunk.
struct FaceArcs {
    static constexpr Index inner_base = Index{1} << 30;
    static constexpr Index branch_base = Index{1} << 31;

    LocalDiagram local;              //!< Positions in the own frame of the face concerned.
    std::vector<Index> arc_face;     //!< #arcs.
    std::vector<Index> branch_face;  //!< #branches.
    std::vector<InnerCrossing> inner;
    std::vector<Index> inner_face;  //!< #inner.

    //! What a face adds to a cell: its area there, and pieces - cuts + sites inside (the face's
    //! part of the cell's Euler characteristic).
    struct CellPart {
        Index site;
        int euler;
        double area;
    };
    std::vector<CellPart> parts;
};

//! The faces [begin, end) of propagation.mixed_faces. A face with sites inside is cut into
//! triangles at them, so that every cell reaches the boundary of some triangle.
//! \param barred  ascending.
[[nodiscard]] FaceArcs trace_faces(const Surface& surface, const Propagation& propagation,
                                   const SitePlacement& placement, const EdgeLabels& labels,
                                   std::span<const BarredSite> barred, double chord_tolerance,
                                   Index begin, Index end);

}  // namespace agvd
