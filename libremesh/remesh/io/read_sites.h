//! \file
//! Reads sites that the user placed.
#pragma once

#include <filesystem>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface_point.h"

namespace remesh {

//! A text file with one site per line, in the order of the result; indices count from 0, as in the
//! arrays of `mesh`:
//!
//!     # a comment, also behind a site
//!     v INDEX             a vertex
//!     f FACE B0 B1 B2     a point of a triangle by its barycentric coordinates
//!     p X Y Z             the nearest point of the mesh (the lowest face, if several are as near)
//!
//! FACE is a triangle of read_mesh's result: where a file has larger polygons, each of them counts
//! as many triangles as it was split into (see MeshFile::face_polygon). A vertex site lies in the
//! lowest of its faces. Barycentric coordinates whose sum differs from 1 by at most 1e-6 are scaled
//! to it.
//!
//! \param mesh  #V x 3 positions, finite; #F x 3 indices, in range; may be dirty otherwise.
//! \throw agvd::IoError       the file cannot be read, a line is none of these, or there is no
//!        site; the text names the file, the line and the remedy.
//! \throw agvd::InvalidInput  an index is out of range, a vertex is in no face, a coordinate is not
//!        finite, or barycentric coordinates are negative or do not sum to 1; names file and line.
//! Cost: O(file size), and O(#F log #F) once for the first `p`.
[[nodiscard]] std::vector<agvd::SurfacePoint> read_sites(const std::filesystem::path& path,
                                                         const agvd::MeshView& mesh,
                                                         const agvd::Progress& progress = {});

}  // namespace remesh
