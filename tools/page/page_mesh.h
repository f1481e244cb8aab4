//! \file
//! A mesh of a page with its values: a description as JSON and a block of bytes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "agvd/mesh/mesh.h"
#include "page/embed.h"

namespace page {

//! A number for each vertex, which the page shows as a colour. Stored in 256 steps.
struct VertexValues {
    std::string key;             //!< Names them for the viewer.
    std::vector<double> values;  //!< #V, finite.
    //! Steps grow linearly, so that most of them are left for the many small values of distances.
    bool has_growing_steps = false;
};

//! A whole number for each face; equal ones get one colour.
struct FaceLabels {
    std::string name;            //!< As in the file.
    std::vector<double> labels;  //!< #F, or none.
    bool has_none = false;       //!< The lowest label stands for faces without one.
};

//! Lines on the surface, each through a part of the points.
struct Polylines {
    std::vector<agvd::Vec3> points;    //!< Line after line.
    std::vector<agvd::Index> lengths;  //!< Points of each line.
};

//! What a page shows of a mesh.
struct PageMesh {
    std::string name = {};                  //!< Of the file.
    agvd::MeshView mesh = {};               //!< As it is drawn.
    std::size_t thinned_from = 0;           //!< Faces that the mesh has; 0: as many as are drawn.
    std::vector<VertexValues> values = {};  //!< For each vertex of `mesh`.
    FaceLabels labels = {};                 //!< For each face of `mesh`.
    std::vector<std::array<agvd::Index, 2>> creases = {};  //!< Pairs of vertices of `mesh`.
    Polylines cells = {};                                  //!< Edges of Voronoi cells.
    Polylines isolines = {};                               //!< Lines of equal distance.
    std::vector<agvd::Vec3> sites = {};                    //!< Points on the surface.
    Polylines site_lines = {};                             //!< Sites that are lines.
};

struct MeshBlock {
    Json description;
    std::string base64;  //!< Of the bytes, compressed with gzip where zlib is there.
};

//! Cost: O(n).
[[nodiscard]] MeshBlock to_block(const PageMesh& mesh);

}  // namespace page
