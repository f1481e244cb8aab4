//! \file
//! Reads and writes geodesic Voronoi diagrams.
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

//! Writes the format of the extension (any case; compressed if .gz follows), to a temporary file
//! that is renamed:
//! - vtp: VTK XML PolyData of the surface's mesh as polygons, each Voronoi edge and each boundary
//!   arc of a cell as a polyline (a closed curve repeats its first point), and each site as a
//!   vertex. Point data `site` (of an edge's point: on its left) and `distance` from it, in mesh
//!   units; cell data `site_left`, `site_right` of the polylines (-1: outside the surface, which
//!   only a boundary arc has; -1 for all other cells).
//! - ply: the surface's mesh as write_mesh writes it, with vertex properties `site` (int) and
//!   `distance` (double; where no site reaches, site is -1 and distance is infinity).
//! - obj: the polylines as `v` and `l` lines, each preceded by a comment `# sites LEFT RIGHT`.
//! - agvd: everything, for read_diagram: such a PLY, and as elements of their own the sites and the
//!   complex. The header's comments explain them.
//!
//! \param sites  those that the diagram was built from.
//! \throw IoError  the extension is unknown or the file cannot be written; says which and
//!        why.
//! \throw Cancelled  the progress callback returned false; an old file is unchanged.
void write_diagram(const std::filesystem::path& path, const Surface& surface,
                   std::span<const SurfacePoint> sites, const Diagram& diagram,
                   const Progress& progress = {});

//! The bytes that write_diagram writes, for write_files_atomically.
//! \throw IoError, Cancelled  as write_diagram.
[[nodiscard]] std::string format_diagram(const std::filesystem::path& path, const Surface& surface,
                                         std::span<const SurfacePoint> sites,
                                         const Diagram& diagram, const Progress& progress = {});

//! \throw IoError  write_diagram does not know the extension; the text lists the known ones.
void check_diagram_extension(const std::filesystem::path& path);

}  // namespace remesh
