//! \file
//! Second half of the diagram: the arcs inside the mixed faces, between the label changes on edges.
#pragma once

#include "agvd/diagram/apollonius.h"
#include "agvd/diagram/inside_relays.h"

namespace agvd {

//! What the faces of one chunk contribute. Crossings and points are those of EdgeLabels, Voronoi
//! vertices those of the chunk.
struct FaceArcs {
    LocalDiagram local;

    //! What a triangle adds to a cell: its area there, and the number of its pieces.
    struct CellPart {
        Index site;
        int pieces;
        double area;
    };
    std::vector<CellPart> parts;

    //! Where a face's contributions begin.
    struct Mark : LocalDiagram::Mark {
        Index parts;
    };
    std::vector<Mark> faces;
    std::vector<std::uint8_t> is_local;  //!< By face: 1: no relays of other faces were asked.

    void clear() {
        local.go_back({});
        parts.clear();
        faces.clear();
        is_local.clear();
    }

    [[nodiscard]] Mark mark() const { return {local.mark(), static_cast<Index>(parts.size())}; }
};

//! Finds the arcs of mixed faces. Most faces have two or three label changes, and there the face's
//! own relays settle all; where they do not agree with each other, what the edges hand on does.
//! \param out  replaced, face after face; its memory is used again.
void find_arcs(const StageInput& input, const RelayGroups& groups, const EdgeLabels& labels,
               std::span<const Index> mixed, FaceArcs& out);

}  // namespace agvd
