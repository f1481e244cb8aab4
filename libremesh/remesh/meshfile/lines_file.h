//! \file
//! Files of polylines: geodesic paths and isolines. Private to the programs.
//! Held by LinesFile in tests/remesh/meshfile.
#pragma once

#include <filesystem>
#include <string>

#include "agvd/core/progress.h"
#include "remesh/meshfile/mesh_file.h"

namespace remesh {

//! Polylines in space.
struct Lines {
    std::vector<Vec3> points = {};  //!< Line after line; a closed one ends with its first point.
    std::vector<Index> offsets{0};  //!< #lines + 1 offsets into points.
    std::vector<Attribute> of_points = {};  //!< Values of each point.
    std::vector<Attribute> of_lines = {};   //!< Values of each line.
};

//! The bytes of the format that the extension names (any case; compressed if .gz follows), for
//! write_files_atomically:
//! - vtp: VTK XML PolyData, the lines as polylines, their values as point and cell data.
//! - obj: `v` and `l` lines; before each `l` a comment `# line NUMBER NAME VALUE ...`.
//! - ply: element vertex with x, y, z, the point's values, and number and values of its line;
//!   element face with vertex_indices: each piece of a line as a face of two vertices; binary.
//! Lines have their number, from 0, as value `line`. One without points is left out. A closed one
//! comes back to its first point.
//! \throw IoError    the extension is unknown.
//! \throw Cancelled  the progress callback returned false.
[[nodiscard]] std::string format_lines(const std::filesystem::path& path, const Lines& lines,
                                       const Progress& progress = {});

//! \throw IoError  format_lines does not know the extension; the text lists the known ones.
void check_lines_extension(const std::filesystem::path& path);

}  // namespace remesh
