//! \file
//! The arcs of the faces of one chunk.
#pragma once

#include <cstdint>

#include "agvd/diagram/local_diagram.h"

namespace agvd {

//! What the faces of one chunk contribute. Crossings and points are those of EdgeLabels, Voronoi
//! vertices those of the chunk.
struct FaceArcs {
    LocalDiagram local;

    //! The part of a triangle in a cell: area, and number of connected pieces.
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
    std::vector<std::uint8_t> is_local;  //!< By face: 1 if the arcs depend on its own relays only.

    void clear() {
        local.go_back({});
        parts.clear();
        faces.clear();
        is_local.clear();
    }

    //! Where the contributions of a face begin; past the last face: the ends of all lists.
    [[nodiscard]] Mark begin_of(Index i) const { return i < faces.size() ? faces[i] : mark(); }
    [[nodiscard]] Mark mark() const { return {local.mark(), static_cast<Index>(parts.size())}; }
};

}  // namespace agvd
