//! \file
//! The Delaunay condition on the dual.
#pragma once

#include <span>

#include "agvd/diagram/diagram.h"
#include "remesh/names.h"

namespace remesh {

//! The lengths by which the Delaunay condition is tested.
enum class Delaunay : std::uint8_t {
    Intrinsic,  //!< Geodesic: of locally shortest paths on the surface.
    Extrinsic,  //!< Straight in space, between the vertices.
    Off,        //!< No test and no flips.
};

//! Lower-case name, for command lines and reports.
[[nodiscard]] const char* delaunay_name(Delaunay delaunay);

//! `{}` gives the defaults.
struct DelaunayOptions {
    Delaunay mode = Delaunay::Intrinsic;  //!< Which edges to flip.
    int num_threads = 0;                  //!< >= 0; 0: all cores. Same bytes for any number.
    Progress progress = {};               //!< Polled during the call; see poll.
};

//! Counts of edges, flips and triangles; all 0 with Delaunay::Off.
struct DelaunayCounts {
    Index inner_edges = 0;     //!< Edges of two faces.
    Index failing_before = 0;  //!< Inner edges whose opposite angles sum to more than pi (by
    Index failing_after = 0;   //!< more than 1e-6), before and after the flips.
    Index flips = 0;           //!< Edges flipped, each as often as it was.
    //! Intrinsic, of all edges: those whose path is not proved locally shortest (see GeodesicPath).
    Index not_locally_shortest = 0;
    //! Intrinsic: triangles with a side longer than the other two together.
    Index broken_triangles = 0;
    bool is_finished = true;  //!< False: stopped after 10 flips for each edge.
};

//! A mesh after the flips.
struct DelaunayResult {
    std::vector<Triangle> triangles;  //!< As many as before.
    //! By triangle, of the sides from corner k to corner k + 1; empty with Delaunay::Off.
    std::vector<std::array<double, 3>> side_lengths;
    DelaunayCounts counts;  //!< Before and after.
};

//! Tests the edges of a triangle mesh on a surface and flips those that fail the Delaunay
//! condition, if the flip is safe: the mesh stays a simplicial complex with the same boundary, no
//! vertex gets fewer than three edges (two on the boundary), and nothing folds over in space.
//!
//! \param points     places of the vertices on the surface.
//! \param positions  the same in space; no two are farther apart than on the surface.
//! \param site       by vertex: its site in the diagram, at the same place; no_index: no site.
//! \param triangles  vertex indices. Edges need not be dual to Voronoi edges. Edges without exactly
//!                   two sides in opposite directions are left unchanged. The vertices of a
//!                   triangle lie on one component.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(size of the complex + faces that the edges cross).
[[nodiscard]] DelaunayResult make_delaunay(const Surface& surface,
                                           std::span<const SurfacePoint> points,
                                           std::span<const Vec3> positions,
                                           std::span<const Index> site, const Diagram& diagram,
                                           std::span<const Triangle> triangles,
                                           const DelaunayOptions& options = {});

}  // namespace remesh
