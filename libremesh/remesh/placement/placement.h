//! \file
//! Places the vertices of a result on and off the surface, so that its triangles are near to the
//! surface and well shaped.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "remesh/curves/curve_sites.h"
#include "remesh/curves/glue.h"
#include "remesh/sites/prepared_surface.h"
#include "remesh/sites/sites.h"
#include "remesh/sites/sizing.h"

namespace remesh {

//! A mesh on its way from the dual to the result. Its vertices belong to points of a surface, but
//! may lie off it.
struct PlacedMesh {
    std::vector<SurfacePoint> points;  //!< #V: where each vertex belongs.
    std::vector<Vec3> offsets;         //!< #V: from there to its position.
    std::vector<Triangle> triangles;
    //! Edges along curves, in one direction or both; those of a single face included.
    std::vector<DirectedEdge> hard = {};
    //! #V: the first vertex at the same place; sheets that meet have one each. Empty: all differ.
    std::vector<Index> place = {};

    [[nodiscard]] Vec3 position(const MeshView& surface, Index v) const {
        return agvd::position(surface, points[v]) + offsets[v];
    }
};

//! Its triangles and positions; those at one place are equal, bit for bit. Cost: O(n).
[[nodiscard]] inline TriangleMesh whole_mesh(const Surface& surface, const PlacedMesh& mesh) {
    TriangleMesh whole{{}, mesh.triangles};
    whole.positions.reserve(mesh.points.size());
    for (Index v = 0; v < mesh.points.size(); ++v) {
        const Index place = mesh.place.empty() ? v : mesh.place[v];
        whole.positions.push_back(mesh.position(surface.mesh.view(), place));
    }
    return whole;
}

//! Least squares along each crease of the distances between points of the curve and of the chain at
//! the same arc length. Nodes stay, and so do the vertices of junctions and kept boundaries.
//! \param surface  that of the network, whole or cut.
//! \return #groups: from each site to the best position of its vertex.
//! Cost: O(vertices of the curves + groups).
[[nodiscard]] std::vector<Vec3> fit_curves(const Surface& surface, const CurveNetwork& network,
                                           const CurveSites& sites,
                                           Boundary boundary = Boundary::Keep);

//! A point of the surface and the area that it stands for.
struct CellSample {
    Vec3 position;
    double area;
    Index vertex;               //!< Of the mesh: in whose cell it lies.
    Index triangle = no_index;  //!< Set by fit_vertices(): the nearest.
};

//! The points by which fit_vertices() measures distances: all that it reads of the pieces.
//! \param nearest_vertex  per vertex of surface.base: the vertex of the mesh in whose cell it lies;
//!                        no_index: none.
//! Cost: O(#base).
[[nodiscard]] std::vector<CellSample> sample_cells(const PreparedSurface& surface,
                                                   std::span<const Index> nearest_vertex,
                                                   Index num_vertices, const Progress& progress);

//! Moves vertices so that the triangles, not their corners, lie as near to the surface as possible,
//! by least squares. Along planes a vertex is drawn to where its triangles are equilateral; where
//! planes meet it slides to their edge. Vertices on the boundary and those marked in `stays` stay,
//! and no triangle turns over.
//! \param nearest_vertex, samples  see sample_cells().
//! \param num_threads     >= 0; 0: all cores. The result is the same for any number.
//! \param least_way       >= 0, mesh units: distances up to this between mesh and surface are
//!                        rounding, without a direction. Above 0 planar parts stay planar.
//! \param stays  #V of the mesh: 1 for vertices that stay; or empty.
//! \throw Cancelled  the progress callback returned false; `mesh` is unspecified then.
//! Cost: O(#base + #mesh), about 2 us for each vertex of the base.
void fit_vertices(const IntrinsicTriangulation& base, std::span<const Index> nearest_vertex,
                  std::vector<CellSample> samples, PlacedMesh& mesh, int num_threads,
                  const Progress& progress, double least_way, std::span<const std::uint8_t> stays);

namespace detail {

//! Where a vertex may go: along the surface, along its curve (Boundary), or nowhere. A Node may be
//! merged with a near vertex, unless it is on the rim.
enum class Mobility : std::uint8_t { Free, Boundary, Node, Fixed };

class MeshCurves;

}  // namespace detail

//! Flips edges, slides vertices, or splits an edge and collapses another one elsewhere, the worst
//! triangles first, where the worst one touched gets better. Keeps the number of vertices (not
//! their order), the topology and the hard edges. Adds no intersections, and distance from the
//! surface only for better shapes.
//! \param curves    where the points of the mesh lie, and the curves along which vertices slide.
//! \param mobility  #V: Fixed ones stay; those on hard edges are not Free.
//! \param faces     of the surface near the mesh, if it is a part of one; empty: all.
//! \throw Cancelled  the progress callback returned false; `mesh` is unchanged.
//! \return for each vertex its old number, #V or more for new ones; empty if nothing changed.
//! Cost: O(#triangles log #triangles), and about a millisecond for each bad one.
std::vector<Index> repair_shape(const detail::MeshCurves& curves,
                                std::span<const detail::Mobility> mobility, PlacedMesh& mesh,
                                const Progress& progress = {}, std::span<const Index> faces = {});

//! Edits triangles that exceed bounds as repair_shape() does, at more distance from the surface.
//! With a longest edge it adds vertices, too.
//! \param most_share  of the triangles: where more exceed the bounds the mesh stays.
//! \throw Cancelled  the progress callback returned false; `mesh` is unchanged.
//! \return as repair_shape(). Cost: that of repair_shape().
std::vector<Index> keep_bounds(const detail::MeshCurves& curves,
                               std::span<const detail::Mobility> mobility,
                               const ShapeBounds& bounds, double most_share, PlacedMesh& mesh,
                               const Progress& progress = {});

//! Moves vertices of intersecting faces off the surface, away from a sheet that faces them, as long
//! as fewer pairs intersect. Those on the rim stay.
//! \param pairs  of faces that intersect.
//! \param most   Free: those on creases stay as well; or Boundary.
//! \return whether any have moved. Cost: O(#surface log #surface), and some queries for each corner.
//! \throw Cancelled  the progress callback returned false; `mesh` is unchanged.
bool push_apart(const detail::MeshCurves& curves, std::span<const detail::Mobility> mobility,
                std::span<const std::pair<Index, Index>> pairs, detail::Mobility most,
                PlacedMesh& mesh, const Progress& progress = {});

//! Edits faces that intersect until they do not, with their number of vertices kept, as by
//! repair_shape().
//! \param pairs  of faces that intersect.
//! \throw Cancelled  the progress callback returned false; `mesh` is unchanged.
//! \return as repair_shape(). Cost: O(#triangles log #triangles), and some ten milliseconds a pair.
std::vector<Index> repair_crossings(const detail::MeshCurves& curves,
                                    std::span<const detail::Mobility> mobility,
                                    std::span<const std::pair<Index, Index>> pairs,
                                    PlacedMesh& mesh, const Progress& progress = {});

//! Whether a triangle has no area, as its corners lie on one line up to rounding: it is less than
//! 1e-10 times as high as it is long.
[[nodiscard]] bool is_flat(std::span<const Vec3> positions, const Triangle& triangle);

//! Flips the longest edge of each triangle without area, so that its third corner divides the
//! neighbour beyond. It stays if that edge is hard, its corners coincide, or the topology would
//! break.
//! \param positions  #V.
//! \param mesh       an oriented manifold.
//! Cost: O(#triangles); O(#triangles log #triangles) if there are any.
void flip_flat_faces(std::span<const Vec3> positions, PlacedMesh& mesh);

}  // namespace remesh
