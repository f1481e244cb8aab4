//! \file
//! What a mesh file holds, and how strictly it is read.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "remesh/meshfile/mesh_attributes.h"

namespace remesh {

//! Where a mesh is read or written, and how.
struct MeshPath {
    //! /dev/stdin and /dev/stdout are the streams of the process, whatever they are connected to.
    std::filesystem::path path;
    //! "ply", "obj", ...; empty: the extension names it, in any case. Either may end in ".gz":
    //! compressed. On reading the file itself tells whether it is.
    std::string format = {};
};

//! What was read from a file.
struct MeshFile {
    TriangleMesh mesh;           //!< As in the file: order kept, defects too.
    Index polygons = 0;          //!< Faces of more than three corners, triangulated.
    Index dropped_polygons = 0;  //!< Faces of fewer than three corners (lines), left out.
    Index welded_vertices = 0;   //!< STL only: corners merged at equal positions.
    //! #F: the polygon (face of the file, from 0) each triangle came from.
    std::vector<Index> face_polygon;
    MeshAttributes attributes;          //!< With ReadOptions::with_attributes.
    std::vector<std::string> warnings;  //!< What was skipped, with the file's name.
    //! What a Medit file wants kept, for the members of RemeshOptions of these names. Edges and
    //! ridges: pairs of vertices.
    std::vector<std::array<Index, 2>> feature_edges = {};
    std::vector<std::array<Index, 2>> locked_edges = {};  //!< Required edges, likewise.
    std::vector<Index> locked = {};                       //!< Required vertices.
};

//! `{}` gives the defaults.
struct ReadOptions {
    //! What a reader passes over is a warning, not an error: whole elements beyond those that the
    //! header announces; in ascii PLY values left over at the end of a line, in PLY lines of the
    //! header without a keyword. A binary STL that announces none is read as far as it goes.
    bool is_lenient = false;
    //! Also read colours, labels and other properties. They take 8 bytes for each value.
    bool with_attributes = false;
    std::string format = {};  //!< See MeshPath.
    Progress progress = {};   //!< Polled during the call; see poll.
};

}  // namespace remesh
