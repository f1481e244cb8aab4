//! \file
//! The Delaunay condition on the dual.
#pragma once

#include <span>

#include "agvd/diagram/diagram.h"

namespace remesh {

//! By which lengths the Delaunay condition is judged.
enum class Delaunay : std::uint8_t {
    Intrinsic,  //!< Geodesic ones: of locally shortest paths over the surface.
    Extrinsic,  //!< Straight ones in space, between the vertices.
    Off,        //!< Not at all.
};

//! Lower-case name, for command lines and reports.
[[nodiscard]] const char* delaunay_name(Delaunay delaunay);

struct DelaunayOptions {
    Delaunay mode = Delaunay::Intrinsic;
    int num_threads = 0;  //!< >= 0; 0: all cores. Same bytes for any number.
    agvd::Progress progress = {};
};

//! What was found and done; all 0 with Delaunay::Off.
struct DelaunayCounts {
    agvd::Index inner_edges = 0;
    agvd::Index failing_before = 0;  //!< Inner edges whose opposite angles sum to more than pi (by
    agvd::Index failing_after = 0;   //!< more than 1e-6), before and after the flips.
    agvd::Index flips = 0;
    //! Intrinsic: edges whose path is not proved locally shortest (see GeodesicPath), of all.
    agvd::Index not_locally_shortest = 0;
    //! Intrinsic: triangles with a side longer than the other two.
    agvd::Index broken_triangles = 0;
    bool is_finished = true;  //!< False: stopped after 10 flips for each edge.
};

struct DelaunayResult {
    std::vector<agvd::Triangle> triangles;
    //! By triangle, of the sides from corner k to corner k + 1; none with Delaunay::Off.
    std::vector<std::array<double, 3>> side_lengths;
    DelaunayCounts counts;
};

//! Judges the edges of a triangle mesh over a surface and flips those that fail the Delaunay
//! condition where that harms nothing: the mesh stays a simplicial complex with the same boundary,
//! no vertex gets fewer than three edges (two on the boundary), nothing folds over in space.
//!
//! \param points     where the vertices lie.
//! \param positions  the same in space: no two farther apart than over the surface.
//! \param site       by vertex: its site in the diagram, where it lies too; no_index: it is none.
//! \param triangles  vertex indices; edges need not be dual to Voronoi edges, and
//!                   those with other than two sides in opposite directions are left alone. The
//!                   vertices of a triangle lie on one component.
//! \throw agvd::Cancelled  the progress callback returned false.
//! Cost: O(size of the complex + faces that the edges cross).
[[nodiscard]] DelaunayResult make_delaunay(const agvd::Surface& surface,
                                           std::span<const agvd::SurfacePoint> points,
                                           std::span<const agvd::Vec3> positions,
                                           std::span<const agvd::Index> site,
                                           const agvd::Diagram& diagram,
                                           std::span<const agvd::Triangle> triangles,
                                           const DelaunayOptions& options = {});

}  // namespace remesh
