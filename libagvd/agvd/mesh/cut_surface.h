//! \file
//! A surface cut open along edges that no path crosses; and faces cut along lines, which become
//! edges. Held by CutSurface and InsertLines in tests/agvd/mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"

namespace agvd {

//! What is left after a cut.
struct OpenedSurface {
    Surface surface;              //!< With a boundary along the cuts.
    std::vector<Index> original;  //!< #V: the vertex of the whole that each is a copy of.
};

//! Cuts a surface along edges, which become boundary edges on both sides. Faces and half-edges keep
//! their numbers, so that points on the surface stay valid: one on a cut is on the side of its
//! face. A vertex has a copy for each wedge between cuts; the first copy keeps the old number, the
//! others come behind all vertices.
//!
//! \param is_cut       #E: 1 for edges to cut; boundary edges may be among them.
//! \param num_threads  >= 0; 0: all cores. The result is the same for any number.
//! \throw InvalidOption  is_cut has not one entry for each edge.
//! \throw Cancelled      the progress callback returned false.
//! Cost: O(n).
[[nodiscard]] OpenedSurface cut_along(const Surface& surface, std::span<const std::uint8_t> is_cut,
                                      int num_threads = 0, const Progress& progress = {});

// --- Lines made edges --------------------------------------------------------------------------

//! What is left of a surface that was cut along lines. Plain values; nothing points back.
struct CutFaces {
    TriangleMesh mesh;                 //!< The surface's vertices first; no T-junctions.
    std::vector<SurfacePoint> points;  //!< #V of the mesh: where each vertex lies on the surface.
    std::vector<Index> face_origin;    //!< #F: the face of the surface that each is a part of.
};

//! A mesh with lines along its edges.
struct MeshWithLines {
    CutFaces cut;  //!< The same surface with smaller faces.
    //! By line: vertices of the mesh, each joined to the next by an edge. Where a line is closed,
    //! the last is the first.
    std::vector<std::vector<Index>> chains;
};

//! Divides the faces that lines cross, so that the lines run along edges: to be sites
//! (SiteShape::edges), or barriers (cut_along()).
//!
//! Where lines cross or touch they get a common vertex. Points within 1e-12 of a face are one.
//! \param lines  points, each joined to the next one by a straight segment in a face that holds both,
//!               such as those of a GeodesicPath.
//! \throw InvalidInput  two points in a row share no face; the text names them.
//! \throw InvalidSites  a point names a face that does not exist, or is off the face.
//! \throw Cancelled     the progress callback returned false.
//! Cost: O(n log n), and O(k^3) in a face with k points on its edges and inside.
[[nodiscard]] MeshWithLines insert_lines(const Surface& surface,
                                         std::span<const std::vector<SurfacePoint>> lines,
                                         const Progress& progress = {});

//! The edges from each vertex of a chain to the next one.
//! \throw InvalidInput  no edge joins two of them; the text names these.
//! Cost: O(faces around the vertices).
[[nodiscard]] std::vector<Index> edges_along(const Surface& surface, std::span<const Index> chain);

}  // namespace agvd
