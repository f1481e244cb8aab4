//! \file
//! The stages of a diagram: what they read, and what they make before it is drawn.
#pragma once

#include <functional>
#include <optional>

#include "agvd/diagram/arc_shapes.h"
#include "agvd/diagram/diagram.h"
#include "agvd/diagram/own_places.h"
#include "agvd/propagation/site_placement.h"

namespace agvd {

//! Keeps references. Stages name mixed faces by their positions in Propagation::mixed_faces.
struct StageInput {
    const Surface& surface;
    std::span<const SurfacePoint> points;  //!< Of the sites that own their own places.
    std::span<const Index> site_of_point;  //!< #points.
    const SitePlacement& placement;        //!< Of the points; their sites, not their numbers.
    const Propagation& propagation;
    // As in DiagramOptions.
    double chord_tolerance;
    std::optional<double> chord;
    int num_threads;
    Poller& poller;
};

//! Of a mixed face whose relays are not needed any more.
inline constexpr RelayRange dropped_relays{no_index, no_index};

struct DiagramParts {
    Index num_sites = 0;
    std::vector<std::vector<Index>> boundary_loops = {};  //!< Of the surface: half-edges.
    EdgeLabels labels = {};
    Arcs arcs = {};  //!< Faces by position.
    JoinedEdges joined = {};
    ArcShapes shapes = {};
};

//! The stages up to the cuts in faces. Keeps references to the arguments of build_diagram().
struct LabelledMesh {
    //! \param may_guess  as of label_edges(). Then only faces are cut in which cells may lie that
    //!                   their labels do not tell of, and nothing is guessed there.
    LabelledMesh(const Surface& surface, std::span<const SurfacePoint> sites,
                 const Propagation& propagation, const DiagramOptions& options,
                 bool may_guess = false);

    Poller poller;
    DiagramParts parts;  //!< All labels; no arcs.
    SitePlaces own;
    SitePlacement placement;
    StageInput input;
    std::vector<Index> all;  //!< The positions of the mixed faces.
};

//! Relabels vertices all of whose faces are mixed: they take the nearest site over the relays of
//! these faces, which may be nearer than the engine knows.
//! \param positions  of these faces, ascending by face.
//! \param is_wanted  #V: 1 for these vertices.
//! \param labels     those of all corners of these faces are known.
//! Cost: O(relays) quick steps.
void label_vertices(const StageInput& input, std::span<const Index> positions,
                    std::span<const std::uint8_t> is_wanted, EdgeLabels& labels);

//! Labels edges all of whose faces are mixed, by the lower envelope of the relays of both sides and
//! of the edge's ends, which are labelled.
//! \param half_edges  the lower one of each edge.
//! \param may_guess   crossings that are certain may be left where they are not known: `guessed`.
//! Parallel. Cost: O(relays) an edge, O(relays) and a few square roots a crossing.
void label_edges(const StageInput& input, std::span<const Index> half_edges, EdgeLabels& labels,
                 bool may_guess = false);

//! Labels edges again that have guessed crossings. \param half_edges  in any order; changed.
void find_guessed(const StageInput& input, std::vector<Index>& half_edges, EdgeLabels& labels);

//! Cuts faces with sites inside into triangles at them. Sites that lie on edges reach the boundary
//! by themselves; a site that owns nothing at its own position is left out.
//! \param positions  ascending by face; the edges of these faces are labelled.
//! Parallel. Cost: the relays near it, a site inside a mixed face, and sorting the face's relays.
void cut_faces(const StageInput& input, std::span<const Index> positions, EdgeLabels& labels);

//! Gives mixed faces their arcs, which are not joined yet.
//! \param positions  all of them; or those of some faces, to trace them again.
//! Parallel.
void trace_faces(const StageInput& input, std::span<const Index> positions, DiagramParts& parts);

//! Makes cells connected: with approximate distances they may have several parts. Gives every part
//! that is not connected to its site to a cell beside it, and traces the faces around it again,
//! until nothing changes. This ends, since label changes only vanish.
//! \return draw_complex() of what comes out; nothing if it would need relays that were dropped.
//! Cost: that of draw_complex() for most diagrams; on the others that of the cells with islands,
//! and O(#V + arcs) quick steps.
[[nodiscard]] std::optional<Diagram> absorb_islands(const StageInput& input, DiagramParts& parts);

//! The node that holds a point, if it is of the point's site; no_index: none, or an inner point.
//! \param i  of input.points.
[[nodiscard]] Index holder_of(const StageInput& input, const EdgeLabels& labels, Index i);

//! Finds the conics that arcs are made of, and draws the arcs by these. Arcs of which the distances
//! contradict each other, or would cross others, stay as they are.
//! \param input  with a chord.
//! Parallel. Cost: O(relays) quick steps a conic, and a few square roots a point; where a face has
//! several arcs, O(points^2) comparisons.
void shape_arcs(const StageInput& input, DiagramParts& parts);

//! The complex without the points of its edges. Cost: O(arcs + boundary).
[[nodiscard]] Diagram draw_complex(const Surface& surface, const DiagramParts& parts,
                                   Ticker ticker);

//! Joins the parts and draws them, with what else a diagram holds, when all faces are traced.
//! \param release  called when the relays have been read for the last time.
//! \return nothing if relays are needed that were dropped.
[[nodiscard]] std::optional<Diagram> draw(const StageInput& input, DiagramParts parts,
                                          const std::function<void()>& release);

//! Adds the points of the edges. Cost: that of their number.
void draw_points(const Surface& surface, const DiagramParts& parts, Ticker ticker,
                 Diagram& diagram);

//! Sets the loops of cells. Cost: O(edges).
void collect_loops(const Diagram& diagram, Ticker& ticker, Cells& cells);

//! Adds what points, edges and cuts are to the Euler characteristics of the cells that hold them.
//! \param euler  #sites
void count_points_and_edges(const Surface& surface, const EdgeLabels& labels, std::span<int> euler);

//! Sets cell_area and cell_euler. Cost: O(#F + crossings).
void measure_cells(const Surface& surface, const DiagramParts& parts, Ticker ticker,
                   Diagram& diagram);

}  // namespace agvd
