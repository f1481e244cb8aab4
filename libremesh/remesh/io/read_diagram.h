//! \file
//! Reads a geodesic Voronoi diagram that write_diagram wrote as .agvd.
#pragma once

#include <filesystem>

#include "agvd/diagram/diagram.h"

namespace remesh {

//! What a file of `agvd diagram` holds.
struct DiagramFile {
    agvd::TriangleMesh mesh;                //!< That the diagram lies on.
    std::vector<agvd::SurfacePoint> sites;  //!< On the mesh, in the order of the cells.
    agvd::Diagram diagram;                  //!< With the points of its edges.
};

//! Returns the data given to write_diagram, bit for bit. Every index is in range; whether the
//! curves form a complex is not checked.
//!
//! \throw agvd::IoError       the file is missing, truncated or malformed, or holds no
//!                            diagram; the text names the file, the place and the remedy.
//! \throw agvd::InvalidInput  the file reads well but an index is out of range, a point is off its
//!                            face, or counts contradict each other.
//! \throw agvd::Cancelled     the progress callback returned false.
[[nodiscard]] DiagramFile read_diagram(const std::filesystem::path& path,
                                       const agvd::Progress& progress = {});

}  // namespace remesh
