//! \file
//! The curves of a surface that its mesh must reproduce: boundary, creases and junctions, where
//! sheets met in the input before cleaning cut them apart. Private to remeshing.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "agvd/core/portable_math.h"
#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "remesh/curves/find_creases.h"

namespace remesh {

//! Radians in [0, pi].
[[nodiscard]] inline double angle_between(const Vec3& a, const Vec3& b) {
    return portable::atan2(a.cross(b).norm(), a.dot(b));
}

//! Vertices and edges of a surface that its mesh keeps.
struct LockedElements {
    std::vector<Index> vertices;        //!< Ascending; the ends of the edges are among them.
    std::vector<std::uint8_t> is_edge;  //!< #E: 1 for locked edges; empty: none.

    [[nodiscard]] bool empty() const { return vertices.empty(); }
    [[nodiscard]] bool has_edge(Index edge) const { return !is_edge.empty() && is_edge[edge] != 0; }
};

//! Copies: elements of a surface that were one before cleaning cut the sheets apart.
struct JunctionSet {
    std::vector<std::vector<Index>> edges;  //!< Two or more each, ascending.
    //! The same for the ends of such edges. Vertices where sheets met in a single point are left
    //! out.
    std::vector<std::vector<Index>> vertices;
    Junctions in_result = Junctions::Apart;  //!< What becomes of the sheets.

    //! Whether no sheets meet in an edge.
    [[nodiscard]] bool empty() const { return edges.empty(); }
};

//! Finds junctions: edges whose ends have the same origins were one edge. Positions do not count.
//! Edges with the same faces on both sides are left out: they lie inside walls of two bodies.
//! \param vertex_origin  #V: see CleanResult; empty: each vertex is its own.
//! Cost: O(#V + #E + k log k), k = edges at vertices that have copies.
[[nodiscard]] JunctionSet find_junctions(const Surface& surface,
                                         std::span<const Index> vertex_origin);

//! Removes connected junctions shorter than least_length (mesh units). Cost: O(#V + k), k = edges
//! of junctions.
void drop_short_junctions(const Surface& surface, double least_length, JunctionSet& junctions);

//! Creases and the edges of junctions: the surface is cut along those with two faces.
//! \param is_crease  #E. Cost: O(#edges of junctions).
[[nodiscard]] std::vector<std::uint8_t> edges_to_cut(const JunctionSet& junctions,
                                                     std::vector<std::uint8_t> is_crease);

//! #V: the first copy of a vertex at a junction; any other vertex itself.
[[nodiscard]] std::vector<Index> first_copies(const JunctionSet& junctions, Index num_vertices);

//! The unit of spacings at a point of the surface, mesh units > 0; empty: spacings are in mesh
//! units.
using UnitAt = std::function<double(const SurfacePoint&)>;

//! One side of a curve: the half-edges of the faces there.
struct CurveSide {
    std::vector<Index> half_edges;  //!< Of the surface, in the curve's order.
    bool runs_along = true;         //!< The half-edges run along the curve; otherwise against it.
    Index sheet = 0;                //!< Equal for the two sides of one edge of the surface.
};

//! A chain of edges between two nodes, or a closed chain without nodes. A boundary has one side, a
//! crease two of one sheet, a junction one for each face that meets there.
struct Curve {
    std::vector<CurveSide> sides;  //!< First those that run along it; each kind by sheet.
    std::vector<double> up_to;  //!< #edges + 1: length before each edge, then of all; mesh units.
    Index begin = no_index;     //!< Index into CurveNetwork::nodes; no_index: closed.
    Index end = no_index;       //!< Index into CurveNetwork::nodes; no_index: closed.
    Index num_sheets = 1;       //!< Above 1: a junction.
    bool is_locked = false;     //!< A locked edge: it is not divided.

    [[nodiscard]] std::size_t num_edges() const { return up_to.size() - 1; }
    [[nodiscard]] double length() const { return up_to.back(); }
    [[nodiscard]] bool is_closed() const { return begin == no_index; }
    [[nodiscard]] bool is_junction() const { return num_sheets > 1; }
    [[nodiscard]] bool is_crease() const { return !is_junction() && sides.size() == 2; }
    //! The vertex before edge i, or after the last one.
    //! \param i  at most num_edges().
    [[nodiscard]] Index vertex(const Surface& surface, std::size_t i, std::size_t side = 0) const;
};

//! Every edge belongs to at most one curve. Nodes are vertices where not two edges of the network
//! meet, boundary and crease meet, or a junction connects its sheets in another way; corners (see
//! corners_of_curve); and locked vertices, which may be nodes without a curve.
struct CurveNetwork {
    std::vector<Index> nodes;   //!< Vertices of the surface, ascending; of copies the first.
    std::vector<Curve> curves;  //!< By lowest edge.
    //! The other copies of nodes at junctions, ascending: vertex, node.
    std::vector<std::pair<Index, Index>> copies;
    Junctions junctions = Junctions::Apart;  //!< What the result does with its sheets.

    [[nodiscard]] bool is_welded() const { return junctions == Junctions::Keep; }
};

//! The node at a vertex of the surface before the cut; no_index if there is none. Cost: O(log n).
[[nodiscard]] Index node_at(const CurveNetwork& network, Index vertex);

//! Finds the network of a surface.
//! \param is_crease  #E: 1 for the edges of creases. Boundary edges and junctions always belong to
//!                   the network.
//! \param spacing    > 0: of the sites, in the units of `unit_at`; corners are found at it.
//! \param locked     its edges that are neither boundary nor junctions must be marked as creases.
//! Cost: O(#V + #E).
[[nodiscard]] CurveNetwork find_network(const Surface& surface,
                                        std::span<const std::uint8_t> is_crease, double spacing,
                                        const JunctionSet& junctions = {},
                                        const LockedElements& locked = {},
                                        const UnitAt& unit_at = {});

//! A loop of boundary_loops as a closed curve that begins at its first vertex. Cost: O(n).
[[nodiscard]] Curve curve_of_loop(const Surface& surface, std::vector<Index> loop);

//! The vertices (see Curve::vertex) where a curve turns by at least 45 degrees, both at the vertex
//! and between the chords to half a spacing before and after it: a rough curve has none; and on the
//! boundary those of at least 25 degrees where it turns by less than half of that over a spacing on
//! both sides. Of several within half a spacing the sharpest counts; so near to an end, none.
//! \return ascending.
//! Cost: O(k log k + k c), c = corners.
[[nodiscard]] std::vector<std::size_t> corners_of_curve(const Surface& surface, const Curve& curve,
                                                        double spacing, const UnitAt& unit_at = {});

//! The share of [begin, end] before a position, in [0, 1]; 0 if the interval is empty, such as an
//! edge that is shorter than the rounding of its curve's length.
[[nodiscard]] inline double share_before(double position, double begin, double end) {
    return begin < end ? std::clamp((position - begin) / (end - begin), 0.0, 1.0) : 0;
}

//! A point of a curve, given in the face on one side of it.
//! \param along  in [0, length]; taken modulo the length on closed curves.
//! \param side   index into its sides.
//! Cost: O(log n).
[[nodiscard]] SurfacePoint point_on_curve(const Curve& curve, double along, std::size_t side = 0);

//! The unit tangent of a curve at a position.
[[nodiscard]] Vec3 tangent_of_curve(const Surface& surface, const Curve& curve, double along);

//! A surface cut along a network of curves.
struct CutSurface {
    const Surface* whole = nullptr;   //!< The surface before the cut, which outlives this.
    std::optional<Surface> own = {};  //!< After it; unset: nothing inside the surface is cut.
    std::vector<Index> original;      //!< #V: the vertex that each is a copy of.
    Index num_original = 0;           //!< Vertices before the cut, their own originals.

    //! Faces and half-edges keep their numbers, so surface points stay valid. A vertex on curves
    //! has a copy for each wedge between them; the first copy keeps the old number.
    [[nodiscard]] const Surface& surface() const { return own ? *own : *whole; }
};

//! Cuts a surface along edges, which become boundary edges on both sides.
//! \param surface  outlives the result.
//! \param is_cut  #E: 1 for edges to cut; boundary edges may be among them.
//! \param num_threads  >= 0; 0: all cores. The result is the same for any number.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n).
[[nodiscard]] CutSurface cut_surface(const Surface& surface, std::span<const std::uint8_t> is_cut,
                                     int num_threads = 0, const Progress& progress = {});

}  // namespace remesh
