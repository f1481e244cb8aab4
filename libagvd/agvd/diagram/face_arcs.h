//! \file
//! Second half of the diagram: the arcs inside the mixed faces, between the label changes on edges.
#pragma once

#include "agvd/diagram/apollonius.h"
#include "agvd/diagram/inside_relays.h"

namespace agvd {

//! What the faces of one chunk contribute. Nodes are the crossings (their index in EdgeLabels) and
//! the chunk's Voronoi vertices from LocalDiagram::first_voronoi_vertex. Intervals have the name of
//! the point at which they end, if there is one, else first_interval + the crossing that they
//! follow along the edge_half or the cut.
struct FaceArcs {
    static constexpr Index first_interval = Index{1} << 31;

    LocalDiagram local;

    //! What a triangle adds to a cell: its area there, and the number of its pieces.
    struct CellPart {
        Index site;
        int pieces;
        double area;
    };
    std::vector<CellPart> parts;

    //! Where a face's contributions begin.
    struct Mark {
        Index points, arcs, voronoi_vertices, connections, parts;
    };
    std::vector<Mark> faces;
    std::vector<std::uint8_t> is_local;  //!< By face: 1: no relays of other faces were asked.

    void clear() {
        local.points.clear();
        local.point_distance.clear();
        local.arcs.clear();
        local.voronoi_vertices.clear();
        local.connections.clear();
        parts.clear();
        faces.clear();
        is_local.clear();
    }

    [[nodiscard]] Mark mark() const {
        return {static_cast<Index>(local.points.size()), static_cast<Index>(local.arcs.size()),
                static_cast<Index>(local.voronoi_vertices.size()),
                static_cast<Index>(local.connections.size()), static_cast<Index>(parts.size())};
    }
};

//! \param mixed  positions in mixed_faces, ascending; out.faces are in their order.
//! \param out    replaced; its memory is used again.
//!
//! Most faces have two or three label changes, and there the face's own relays settle all; where
//! they do not agree with each other, what the edges hand on does.
void trace_faces(const Surface& surface, const Propagation& propagation, const RelayGroups& groups,
                 const EdgeLabels& labels, double chord_tolerance, std::span<const Index> mixed,
                 Ticker ticker, FaceArcs& out);

}  // namespace agvd
