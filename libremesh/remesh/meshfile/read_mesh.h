//! \file
//! Reads PLY, OBJ, OFF, STL, VTK, Medit, 3MF and glTF.
#pragma once

#include <filesystem>

#include "remesh/meshfile/mesh_file.h"

namespace remesh {

//! The format is ReadOptions::format, or that of the extension: ply (ascii and both binaries), obj
//! (v, v/vt, v//vn and v/vt/vn, negative indices; never split along texture seams), off (OFF, COFF,
//! NOFF, STOFF), stl (ascii, binary; welded at equal positions), vtk (legacy), vtp and vtu (VTK's
//! XML), mesh (Medit, ascii), 3mf, glb, gltf (which may name files beside it); each also compressed
//! with gzip. /dev/stdin is the standard input. Coordinates are kept in double. A quad is cut along
//! the shorter of its inner diagonals, a larger polygon by clipping ears.
//!
//! \throw IoError       the file is missing, empty, unreadable, truncated, malformed or
//!        longer than its header announces (a few stray bytes are only a warning), or the extension
//!        is unknown; the text names the file, the line (or byte) and the remedy.
//! \throw InvalidInput  the file reads well but is no usable mesh: no face (a point cloud),
//!        an index out of range, a coordinate that is not finite; the text names file and element.
//! Cost: O(file size), and O(k^2) for each polygon of k corners. Memory follows the size of the
//! file, never a count that it announces.
//! \throw Cancelled     the progress callback returned false.
[[nodiscard]] MeshFile read_mesh(const std::filesystem::path& path, const Progress& progress = {});
//! The same with options.
[[nodiscard]] MeshFile read_mesh(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace remesh
