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
//! - obj: `v` and `l` lines; before each `l` a comment `# NAME VALUE ...` with the line's values.
//! - ply: element vertex with x, y, z and the points' values, element edge with vertex1, vertex2,
//!   line (its number, from 0) and the line's values; binary.
//! A line without points is left out of obj, and has no edge in ply.
//! \throw IoError    the extension is unknown.
//! \throw Cancelled  the progress callback returned false.
[[nodiscard]] std::string format_lines(const std::filesystem::path& path, const Lines& lines,
                                       const Progress& progress = {});

//! \throw IoError  format_lines does not know the extension; the text lists the known ones.
void check_lines_extension(const std::filesystem::path& path);

}  // namespace remesh
