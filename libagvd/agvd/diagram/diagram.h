//! \file
//! The approximate geodesic Voronoi diagram as a cell complex on the surface, with the boundary of
//! each cell and the pieces of each edge within faces. Cells are connected, and their Euler
//! characteristics add up to that of the surface.
//! The same bytes for any number of threads.
//! Held by Complex.IsValid, BisectorArcs and Diagram.SameBytesForAnyThreadCountAndLambda in
//! tests/agvd/diagram.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "agvd/core/progress.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/propagation/propagate.h"

namespace agvd {

//! A Voronoi edge, or an arc of the surface's boundary inside one cell (right: none).
struct VoronoiEdge {
    SiteId left;            //!< Cell on the left, walking from the first point to the last.
    SiteId right;           //!< Cell on the right; invalid: outside the surface.
    Index tail = no_index;  //!< Voronoi vertex at the first point; no_index: a closed curve.
    Index head = no_index;  //!< Voronoi vertex at the last point; no_index: a closed curve.
};

//! Through which side of the face that names a point the curve passes there. On an ordinary mesh
//! the points of a piece tell its face; where faces share two edges, or a face has a vertex twice,
//! this does: see curve_piece().
struct Passage {
    static constexpr std::uint8_t none = 3;  //!< No side of the face.
    //! 0 to 2: half-edge 3 f + side; none: the curve comes and goes on in the face. On the
    //! surface's boundary the half-edge along which the curve goes on (or ends).
    std::uint8_t side = none;
    //! The curve goes out of the face; else it comes in. On the boundary: it comes from the
    //! half-edge before, over a mesh vertex.
    bool leaves = false;

    //! Whether both parts are equal.
    friend bool operator==(const Passage&, const Passage&) = default;
};

//! One end of a Voronoi edge at a Voronoi vertex.
struct EdgeEnd {
    Index edge = no_index;  //!< Of Diagram::edges.
    bool is_tail = false;   //!< True: the edge starts at this vertex.
};

//! The shape of an arc. Sites are points, so there are no parabolas: these are as far from a point
//! as from a line.
enum class ArcKind : std::uint8_t {
    Line,       //!< The weights are equal, or differ by the distance of the foci.
    Hyperbola,  //!< A piece of one branch.
    Chord,      //!< Drawn straight where distances with errors contradict each other: no foci.
};

//! Lower-case name of a kind, for files.
[[nodiscard]] const char* arc_kind_name(ArcKind kind);

//! The points p of a face with |p - focus[0]| + weight[0] = |p - focus[1]| + weight[1], from
//! `begin` to `end`. This sum is the distance of p from both sites. Positions are in the frame of
//! half-edge 3 face, as those of IsolineArc; lengths are mesh units. Of a chord only the ends
//! count.
//!
//! If the distances have errors, the ends of the polyline lie beside the conic by about these.
struct BisectorArc {
    FaceId face;                    //!< In which it lies.
    ArcKind kind = ArcKind::Chord;  //!< Its shape.
    Index first_point = 0;          //!< Of Diagram::points, at `begin`.
    //! Of the site on the left of the edge, and on the right.
    std::array<Vec2, 2> focus{Vec2(0, 0), Vec2(0, 0)};
    std::array<double, 2> weight{};  //!< Distances of the sites from these.
    Vec2 begin{0, 0};                //!< First point.
    Vec2 end{0, 0};                  //!< Last point.

    //! Whether all fields are equal.
    friend bool operator==(const BisectorArc&, const BisectorArc&) = default;
};

//! The complex. Voronoi vertices are the points where three or more cells (or two cells and the
//! outside) meet; around vertex v, counter-clockwise, edge end i is followed by the cell
//! vertex_sites[i].
struct Diagram {
    Index num_sites = 0;  //!< Sites, and cells: some may be empty.

    std::vector<SurfacePoint> points;    //!< Polyline points, edge after edge; a closed curve does
                                         //!< not repeat its first point.
    std::vector<double> point_distance;  //!< Distance of each point from the sites it is between.
    std::vector<Passage> passages;       //!< By point; none in a diagram from a file.
    std::vector<Index> edge_points;      //!< #edges + 1 offsets into points.
    std::vector<VoronoiEdge> edges;      //!< With the cells on both sides.

    //! With DiagramOptions::chord what edges between cells are made of, edge after edge. An arc
    //! goes on to the first point of the next one, the last to the end of its edge. Edges on the
    //! surface's boundary have none.
    std::vector<BisectorArc> arcs;
    std::vector<Index> edge_arcs;  //!< #edges + 1 offsets into arcs; empty without arcs.

    std::vector<Index> vertex_offsets;    //!< #vertices + 1 offsets into the next two.
    std::vector<EdgeEnd> vertex_ends;     //!< Counter-clockwise edge ends.
    std::vector<SiteId> vertex_sites;     //!< The cell after each end; invalid: outside.
    std::vector<SurfacePoint> vertices;   //!< Where each Voronoi vertex lies.
    std::vector<double> vertex_distance;  //!< Its distance from its sites.

    std::vector<SiteId> nearest_site;      //!< #V of the mesh: the cell that holds each vertex;
    std::vector<double> nearest_distance;  //!< invalid and infinity where no site reaches.

    //! #sites, square mesh units; 0 for a site that owns nothing. Each part of a cell is rounded to
    //! 2^-61 of the surface's area, so that sums do not depend on an order.
    std::vector<double> cell_area;
    std::vector<int> cell_euler;  //!< #sites: Euler characteristic of each cell (a disc has 1).
};

//! A straight piece of a curve, both ends as points of the face that it crosses.
struct CurvePiece {
    SurfacePoint from;  //!< First end.
    SurfacePoint to;    //!< Other end; in the same face.
};

//! The piece of a Voronoi edge, or of an arc of the boundary, from one of its points to the next.
//! \param point  index in diagram.points, not the last one of an edge that is open.
[[nodiscard]] CurvePiece curve_piece(const Surface& surface, const Diagram& diagram, Index edge,
                                     Index point);

//! Mesh units, within the faces; of a closed curve without its last piece.
//! Cost: O(points of the edge).
[[nodiscard]] double curve_length(const Surface& surface, const Diagram& diagram, Index edge);

//! The polyline of an arc: indices into diagram.points, from its begin to its end. Of a closed
//! curve the last one may be the first point of its edge.
//! \param arc  one of the arcs of the edge.
[[nodiscard]] std::vector<Index> points_of_arc(const Diagram& diagram, Index edge, Index arc);

//! A directed edge of the complex with the cell on its left.
struct LoopEdge {
    Index edge = no_index;  //!< Of Diagram::edges.
    bool reversed = false;  //!< True: walked from head to tail.
};

//! Cell s has the loops [cell_loops[s], cell_loops[s + 1]); loop l has the directed edges
//! [loop_edges[l], loop_edges[l + 1]) of `edges`, head to tail, the cell on their left. A cell that
//! covers a whole closed component has no loop.
struct Cells {
    std::vector<Index> cell_loops;         //!< #sites + 1 offsets into loops.
    std::vector<Index> loop_edges;         //!< #loops + 1 offsets into edges.
    std::vector<LoopEdge> edges;           //!< Loop by loop.
    std::vector<Index> neighbour_offsets;  //!< #sites + 1 offsets into neighbours.
    std::vector<SiteId> neighbours;        //!< Ascending, without repetition.
};

//! The diagram seen cell by cell. Cost: O(size of the complex).
[[nodiscard]] Cells build_cells(const Diagram& diagram, Ticker ticker = {});

// --- Building it --------------------------------------------------------------------------------

//! `{}` gives the defaults.
struct DiagramOptions {
    double chord_tolerance = 0.01;  //!< Arcs are sampled to this share of their chord's length.
    //! If given: Diagram::arcs is made, and polylines stray from the arcs by at most so much, mesh
    //! units, > 0.
    std::optional<double> chord = {};
    int num_threads = 0;     //!< >= 0; 0: all cores. Same bytes for any number.
    Progress progress = {};  //!< Polled during the call; see agvd::poll.
};

//! Builds local Apollonius diagrams in the mixed faces and joins them ([meng2023] Sec. 4.2, 5.3).
//!
//! Cost: O(k) per mixed face and label change, k = relays of the face. Re-entrant.
//! \throw InvalidOption  the chord is not above 0.
//! \throw Cancelled  the progress callback returned false.
[[nodiscard]] Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                                    const Propagation& propagation,
                                    const DiagramOptions& options = {});

//! The same for a propagation that is not needed any more. Its relays are freed before the diagram
//! is drawn: they take more than a third of the memory then.
[[nodiscard]] Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                                    Propagation&& propagation, const DiagramOptions& options = {});

//! What trace_diagram() makes.
struct TracedDiagram {
    Diagram diagram;  //!< As build_diagram() gives it.
    //! As Propagation::certified_error.
    double certified_error = std::numeric_limits<double>::infinity();
    std::size_t most_relays = 0;  //!< Relays held at once.
};

//! Both in one call, for callers that do not read the propagation: the diagram has the same bytes.
//! With the Steiner engine, faces are traced and their relays dropped as soon as the front has left
//! them behind ([meng2023] Algorithm 1), every `lambda` * #F pops, unless an error or a chord is
//! asked for.
//!
//! \throw as propagate() and build_diagram().
//! Cost: that of both. If islands are absorbed in places where there were none, which nothing
//! excludes and no mesh has shown, it propagates twice.
[[nodiscard]] TracedDiagram trace_diagram(const Surface& surface,
                                          std::span<const SurfacePoint> sites,
                                          const PropagationOptions& propagating,
                                          const DiagramOptions& options = {});

//! What the dual of a diagram needs: which cells meet, not where. Its labels, Voronoi vertices and
//! Euler characteristics are those of build_diagram().
//! Held by CellComplex.IsThatOfTheDiagram in tests/agvd/diagram.
struct CellComplex {
    Index num_sites = 0;  //!< Sites, and cells: some may be empty.

    //! The cells around each Voronoi vertex inside the surface, counter-clockwise from any of them.
    //! At most one is invalid: where no site reaches.
    std::vector<std::array<SiteId, 3>> vertex_sites;
    std::vector<FaceId> vertex_face;  //!< In which each lies, ascending.

    std::vector<SiteId> nearest_site;    //!< #V of the mesh, as Diagram::nearest_site.
    std::vector<int> cell_euler;         //!< #sites, as Diagram::cell_euler.
    std::vector<std::uint8_t> has_cell;  //!< #sites: whether each owns any point.

    //! #E of the mesh: 1 where labels change more often along the edge than those of its ends tell:
    //! from a to b and on to c, or to b and back.
    std::vector<std::uint8_t> has_hidden_change;
};

//! The cells and Voronoi vertices of build_diagram() without arcs and positions. Bisectors are
//! drawn only in faces that more than three change labels around, and everywhere if there are
//! islands.
//!
//! Cost: some three quarters of build_diagram(); more than that where there are islands.
//! Re-entrant.
//! \param options  the chord is not used.
//! \throw Cancelled  the progress callback returned false.
[[nodiscard]] CellComplex build_cell_complex(const Surface& surface,
                                             std::span<const SurfacePoint> sites,
                                             const Propagation& propagation,
                                             const DiagramOptions& options = {});

//! The same complex with all points on base.input(): Voronoi edges get a point where they cross an
//! edge of the input, so that consecutive points share a face of it as before. The distances of
//! these points are interpolated. Labels are those of the input's vertices. With arcs these points
//! lie on the arcs, which end there; areas of cells follow.
//! \param diagram  of base.surface().
//! \throw Cancelled  the progress callback returned false.
//! Cost: that of mapping each segment.
[[nodiscard]] Diagram diagram_on_input(const IntrinsicTriangulation& base, Diagram diagram,
                                       const Progress& progress = {});

//! The point of an arc at a share of its way, in its face's frame: 0 is its begin, 1 its end.
//! Others lie on the ray from a focus through the chord's point at this share.
[[nodiscard]] Vec2 point_on_arc(const BisectorArc& arc, double share);

//! Where the foci lie in the plane of the arc's face in space, which holds the arc as well. Where a
//! surface has lengths in place of positions, the face is drawn with another shape, and so are
//! they.
[[nodiscard]] std::array<Vec3, 2> foci_in_space(const Surface& surface, const BisectorArc& arc);

}  // namespace agvd
