//! \file
//! The mesh cut along the bisectors of a diagram: triangles, each in one cell.
//! Held by CutCells in tests/agvd/diagram.
#pragma once

#include <vector>

#include "agvd/core/progress.h"
#include "agvd/diagram/diagram.h"

namespace agvd {

//! What a cut makes. Plain values; nothing points back.
struct CutCells {
    TriangleMesh mesh;                 //!< The surface's vertices first; no T-junctions.
    std::vector<SurfacePoint> points;  //!< #V of the mesh: where each vertex lies on the surface.
    std::vector<SiteId> face_site;   //!< #F: the cell of each face; invalid where no site reaches.
    std::vector<Index> face_origin;  //!< #F: the face of the surface that each is a part of.
};

//! Cuts the faces of a surface along the polylines of its diagram. The triangles of a cell have its
//! area, but for rounding. Each edge is cut at the same points on both sides, so the result is a
//! manifold with the surface's boundary. Triangles may be as narrow as the polylines force.
//!
//! \param diagram  of the surface, or mapped to it by diagram_on_input().
//! \throw InvalidInput  two points of a polyline that follow on each other share no face.
//! \throw Cancelled     the progress callback returned false.
//! Cost: O(n log n), and O(k^3) in a face with k points on its edges and inside.
[[nodiscard]] CutCells cut_cells(const Surface& surface, const Diagram& diagram,
                                 const Progress& progress = {});

}  // namespace agvd
