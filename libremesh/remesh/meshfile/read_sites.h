//! \file
//! Reads sites, vertices and edges that the user named.
#pragma once

#include <filesystem>
#include <string>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh {

//! What was read from a file of sites.
struct SitesFile {
    std::vector<SurfacePoint> sites;    //!< In the file's order.
    std::vector<std::string> warnings;  //!< With the file's name and the line.
};

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
//! to it. Points that are off the mesh by more than a hundredth of the sites' spacing (the square
//! root of area / sites) are a warning, and so are sites that lie exactly where earlier ones do.
//!
//! \param mesh  #V x 3 positions, finite; #F x 3 indices, in range; may be dirty otherwise.
//! \throw IoError       the file cannot be read, a line is none of these, or there is no
//!        site; the text names the file, the line and the remedy.
//! \throw InvalidInput  an index is out of range, a vertex is in no face, a coordinate is not
//!        finite, barycentric coordinates are negative or do not sum to 1, or a point is off the
//!        mesh by more than the spacing; names file and line.
//! Cost: O(file size + n log n), and O(#F log #F) once for the first `p`.
[[nodiscard]] SitesFile read_sites(const std::filesystem::path& path, const MeshView& mesh,
                                   const Progress& progress = {});

//! A text file with one vertex per line, counted from 0 as in the arrays of read_mesh's result;
//! what follows # is a comment.
//!
//! \throw IoError  the file cannot be read, a line has another form, or there is no vertex.
//! \throw InvalidInput  the mesh has no such vertex, or it is in no face.
//!        Both name the file, the line and the remedy.
//! Cost: O(file size + #F).
[[nodiscard]] std::vector<Index> read_vertices(const std::filesystem::path& path,
                                               const MeshView& mesh, const Progress& progress = {});

//! A text file with two vertices per line, counted from 0 as in the arrays of read_mesh's result;
//! what follows # is a comment.
//!
//! \throw IoError  the file cannot be read, a line has another form, or there is no edge; the
//!        text names the file, the line and the remedy.
//! \throw InvalidInput  a number is beyond 64 bits.
//! Cost: O(file size).
[[nodiscard]] std::vector<std::array<Index, 2>> read_edges(const std::filesystem::path& path,
                                                           const Progress& progress = {});

}  // namespace remesh
