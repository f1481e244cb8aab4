//! \file
//! The dual of the diagram: a vertex per cell, a triangle per Voronoi vertex. The Delaunay
//! condition on its edges. Held by BuildDual.HasTheTopologyOfManySites and
//! MakeDelaunay.HoldsOnRandomMeshesWhateverTheDual in tests/remesh/dual.
#pragma once

#include <cstdint>
#include <span>

#include "agvd/diagram/diagram.h"
#include "remesh/names.h"

namespace remesh {

//! Triangles of site indices, oriented like the surface: one for each Voronoi vertex, k - 2 where k
//! cells meet. They are a triangulation of the surface where all cells are discs and share no more
//! than arcs; the caller checks that. Sites without a cell or Voronoi vertex occur in no triangle.
//! Cost: O(#vertices).
[[nodiscard]] std::vector<Triangle> build_dual(const Diagram& diagram);

//! Where the triangles of a dual come from. Copies of a site on the sides of a curve count each.
struct DualCounts {
    Index sites = 0;           //!< Those that own a part of the surface.
    Index sites_of_cells = 0;  //!< Of these: all their triangles are those of the cells.
    //! Sites whose cells are no discs or share more than one arc, and those of curves where the
    //! cell of another site meets the curve.
    Index narrow_sites = 0;
    Index simplified_parts = 0;  //!< Parts around these that were simplified to their sites.
    //! Of these: whole patches between curves, or components, as narrow sites are all around.
    Index simplified_patches = 0;

    //! Adds those of another part of the surface.
    void add(const DualCounts& more) {
        sites += more.sites;
        sites_of_cells += more.sites_of_cells;
        narrow_sites += more.narrow_sites;
        simplified_parts += more.simplified_parts;
        simplified_patches += more.simplified_patches;
    }
};

//! The lengths by which the Delaunay condition is tested.
enum class Delaunay : std::uint8_t {
    Intrinsic,  //!< Geodesic: of locally shortest paths on the surface.
    Extrinsic,  //!< Straight in space, between the vertices.
    Off,        //!< No test and no flips.
};

//! Lower-case name, for command lines and reports.
[[nodiscard]] const char* delaunay_name(Delaunay delaunay);

//! Two vertices are at most so far from each other on the surface.
struct PairBound {
    std::uint64_t ends = 0;  //!< edge_key(a, b).
    double most = 0;         //!< Mesh units.

    //! By ends, then by length.
    [[nodiscard]] auto operator<=>(const PairBound&) const = default;
};

//! `{}` gives the defaults.
struct DelaunayOptions {
    Delaunay mode = Delaunay::Intrinsic;  //!< Which edges to flip.
    //! #V, below #V: equal for copies of one vertex on several sides of a cut; empty: all differ.
    //! No flip joins two vertices that another edge joins already.
    std::span<const Index> group = {};
    //! Intrinsic: ascending, the least one of each pair first. With these and the straight lengths
    //! most edges are proved to meet the condition, and are not measured.
    std::span<const PairBound> bounds = {};
    int num_threads = 0;     //!< >= 0; 0: all cores. Same bytes for any number.
    Progress progress = {};  //!< Polled during the call; see poll.
};

//! Counts of edges, flips and triangles; all 0 with Delaunay::Off.
struct DelaunayCounts {
    Index inner_edges = 0;     //!< Edges of two faces.
    Index failing_before = 0;  //!< Inner edges whose opposite angles sum to more than pi (by
    Index failing_after = 0;   //!< more than 1e-6), before and after the flips.
    Index flips = 0;           //!< Edges flipped, each as often as it was.
    Index measured_edges = 0;  //!< Before the flips: the others are proved by bounds.
    //! Intrinsic: of these, before the flips; see GeodesicPath.
    Index not_locally_shortest = 0;
    //! Intrinsic: triangles with a side longer than the other two together.
    Index broken_triangles = 0;
    bool is_finished = true;  //!< False: stopped after 100 passes.
};

//! A mesh after the flips.
struct DelaunayResult {
    std::vector<Triangle> triangles;  //!< As many as before.
    DelaunayCounts counts;            //!< Before and after.
};

//! Tests the edges of a triangle mesh on a surface and flips those that fail the Delaunay
//! condition, if the flip is safe: the new edge meets the condition, the mesh stays a simplicial
//! complex with the same boundary, no vertex gets fewer than three edges (two on the boundary), and
//! in space no edge around becomes sharper than 60 degrees, or than the sharpest one there before.
//! \param points     the vertices on the surface.
//! \param positions  the same in space; no two are farther apart than on the surface.
//! \param triangles  vertex indices. Edges without exactly two sides in opposite directions are
//!                   left unchanged. The vertices of a triangle lie on one component.
//! \throw Cancelled  the progress callback returned false.
//! Cost: that of path_between for each edge that no bounds prove.
[[nodiscard]] DelaunayResult make_delaunay(const Surface& surface,
                                           std::span<const SurfacePoint> points,
                                           std::span<const Vec3> positions,
                                           std::span<const Triangle> triangles,
                                           const DelaunayOptions& options = {});

}  // namespace remesh
