//! \file
//! Reads a geodesic Voronoi diagram that write_diagram wrote as .agvd.
#pragma once

#include <filesystem>

#include "agvd/diagram/diagram.h"
#include "remesh/names.h"

namespace remesh {

//! What a file of `agvd diagram` holds.
struct DiagramFile {
    TriangleMesh mesh;                //!< That the diagram lies on.
    std::vector<SurfacePoint> sites;  //!< On the mesh, in the order of the cells.
    Diagram diagram;                  //!< With the points of its edges.
};

//! Returns the data given to write_diagram, bit for bit. Every index is in range; whether the
//! curves form a complex is not checked.
//!
//! \throw IoError       the file is missing, truncated or malformed, or holds no
//!                            diagram; the text names the file, the place and the remedy.
//! \throw InvalidInput  the file reads well but an index is out of range, a point is off its
//!                            face, or counts contradict each other.
//! \throw Cancelled     the progress callback returned false.
[[nodiscard]] DiagramFile read_diagram(const std::filesystem::path& path,
                                       const Progress& progress = {});

}  // namespace remesh
