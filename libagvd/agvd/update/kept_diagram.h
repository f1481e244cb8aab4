//! \file
//! What an update of a diagram leaves to the next one.
#pragma once

#include "agvd/diagram/absorb_islands.h"
#include "agvd/diagram/draw_complex.h"
#include "agvd/update/renumbering.h"

namespace agvd {

//! The parts of the diagram that was drawn last, and what an update starts from.
struct KeptDiagram {
    DiagramParts parts;
    CellSet displaced;         //!< Sites whose place belongs to another cell.
    AbsorbedIslands absorbed;  //!< Since the labels were found.
    std::vector<FaceVoronoiVertices> voronoi_vertices;  //!< By face.
    bool is_renumbered = false;                         //!< Since the diagram was drawn.
    // Memory for the points of the next diagram.
    std::vector<SurfacePoint> points{};
    std::vector<double> point_distance{};
    std::vector<Passage> passages{};
};

//! Gives the sites that are left their new numbers. Cost: O(size of the diagram).
void renumber(const Renumbering& new_site, KeptDiagram& kept);

//! Whether more memory is released than in use: building a new diagram is better then.
[[nodiscard]] bool is_wasteful(const DiagramParts& parts);

}  // namespace agvd
