//! \file
//! Writes a geodesic Voronoi diagram for viewers.
#pragma once

#include <filesystem>
#include <span>

#include "agvd/diagram/diagram.h"

namespace remesh {

//! Writes the format of the extension (any case), to a temporary file that is renamed:
//! - vtp: VTK XML PolyData. Each Voronoi edge and each boundary arc of a cell is a polyline (a
//!   closed curve repeats its first point); cell data `site_left`, `site_right` (-1: outside the
//!   surface, which only a boundary arc has), point data `distance` from the two sites, in mesh
//!   units.
//! - obj: the same polylines as `v` and `l` lines, each preceded by a comment `# sites LEFT RIGHT`.
//! - ply: everything, for read_diagram: the surface's mesh, binary little-endian, with vertex
//!   properties `site` (int) and `distance` (double; where no site reaches, site is -1 and distance
//!   is infinity), and as elements of their own, which other readers pass over, the sites and the
//!   complex. The header's comments explain them.
//!
//! \param sites  those that the diagram was built from.
//! \throw agvd::IoError  the extension is unknown or the file cannot be written; says which and
//!        why.
//! \throw agvd::Cancelled  the progress callback returned false; an old file is unchanged.
void write_diagram(const std::filesystem::path& path, const agvd::Surface& surface,
                   std::span<const agvd::SurfacePoint> sites, const agvd::Diagram& diagram,
                   const agvd::Progress& progress = {});

//! The bytes that write_diagram writes, for write_files_atomically.
//! \throw agvd::IoError, agvd::Cancelled  as write_diagram.
[[nodiscard]] std::string format_diagram(const std::filesystem::path& path,
                                         const agvd::Surface& surface,
                                         std::span<const agvd::SurfacePoint> sites,
                                         const agvd::Diagram& diagram,
                                         const agvd::Progress& progress = {});

//! True for the extensions that write_diagram knows.
[[nodiscard]] bool is_known_diagram_extension(const std::filesystem::path& path);

}  // namespace remesh
