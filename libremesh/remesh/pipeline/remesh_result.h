//! \file
//! The result of remesh(): the mesh, and counts of what was done.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/topology.h"
#include "remesh/clean/clean_input.h"
#include "remesh/dual/build_dual.h"
#include "remesh/pipeline/remesh_options.h"
#include "remesh/quality/evaluate.h"
#include "remesh/sites/relax_sites.h"

namespace remesh {

//! What became of the creases.
struct FeatureCounts {
    Index curves = 0;    //!< Chains between nodes, and closed chains; the boundary's included.
    Index nodes = 0;     //!< Points where curves turn sharply, end or meet.
    Index vertices = 0;  //!< Vertices of the result on curves and nodes.
    double length = 0;   //!< Of the creases that were kept, in mesh units.
    double dropped_length = 0;  //!< Of the dropped creases: the sites are too few or lie elsewhere.
    Index uncarried_curves = 0;  //!< Creases that given sites do not lie on.
    Index samples_for_all = 0;   //!< Fewest samples that keep all creases.
    Index thinned_patches = 0;   //!< Patches that are too narrow for Voronoi cells.
    //! Creases were dropped because no mesh with all of them was found, or only one that
    //! self-intersects.
    bool gave_up = false;
    double seam_length = 0;  //!< Of RemeshOptions::texture_seams that became curves, mesh units.
    double dropped_seam_length = 0;  //!< Of the others: too close to each other, or too short.
};

//! What became of the input's edges with more than two faces.
struct JunctionCounts {
    Index edges = 0;     //!< In the cleaned input; copies on several sheets count once.
    Index curves = 0;    //!< Chains of such edges between nodes, and closed chains.
    Index vertices = 0;  //!< Vertices of the result on these curves.
    //! Edges of the input along which each sheet has points of its own: no mesh with equal points
    //! was found, or the options exclude it.
    Index apart_edges = 0;
    Index samples_for_all = 0;  //!< Fewest samples that give equal points everywhere.
    Index welded_edges = 0;     //!< Edges of the result with more than two faces.
};

//! Lengths of the result's edges, in mesh units.
struct SizingResult {
    Index num_samples = 0;  //!< Asked for, or as edge length, faces or targets gave it.
    double mean_edge = 0;   //!< Of the result.
    //! Least and largest target at the result's vertices. 0: all targets are equal.
    double least_target = 0;
    double largest_target = 0;  //!< See least_target.
    //! Edges over the mean of the targets at their ends: 5th and 95th percentile.
    double low_ratio = 0;
    double high_ratio = 0;  //!< See low_ratio.
    //! Both ways between result and input, at many points of each; all others are proved to be
    //! within that of MaxDistance. 0: not measured, as that is not used.
    double largest_distance = 0;
};

//! What a run with RemeshOptions::region left as it was. Vertices and faces of the result that are
//! not listed come after those that are. Empty: the whole mesh was remeshed.
struct KeptPart {
    std::vector<Index> vertices;  //!< The caller's, ascending: the first ones of the result.
    std::vector<Index> faces;     //!< Likewise.
    Index seam_edges = 0;         //!< Edges between kept and remeshed faces.
};

//! Pairs of faces of a result that intersect.
struct CrossingCounts {
    Index all = 0;    //!< See RemeshResult::self_intersections.
    Index fresh = 0;  //!< See RemeshResult::new_self_intersections.
};

//! Plain values owned by the caller; nothing points back into the input.
struct RemeshResult {
    //! Oriented 2-manifold with the topology of the cleaned input; Junctions::Keep welds its sheets
    //! at junctions. With a region the other faces are as they were, and what follows is about the
    //! region, but for `sites`; its intersections with other faces count.
    TriangleMesh mesh;
    KeptPart kept = {};               //!< With a region.
    std::vector<SurfacePoint> sites;  //!< One per output vertex: where it lies on the input
                                      //!< (faces are the caller's).
    CleanCounts cleaned;              //!< What cleaning repaired.
    double welded_slit_length = 0;    //!< See CleanResult::slit_length.
    Topology input_topology;          //!< Of the cleaned input.
    Index refined_faces = 0;          //!< Faces of the base, on which propagation runs.
    Index components_dropped = 0;     //!< See drop_components.
    Index sites_added = 0;            //!< By topology repair and against self-intersections.
    std::map<SiteReason, Index> added_because = {};  //!< The same by reason.
    Index sites_moved = 0;        //!< Onto the boundary, or from places where they owned nothing.
    Index sites_removed = 0;      //!< Vertices removed to keep the count.
    Index sites_dropped = 0;      //!< Given sites that own nothing (e.g. duplicates).
    int repair_rounds = 0;        //!< Rounds of moving and adding.
    Index unfitted_vertices = 0;  //!< Moved back onto the surface: triangles intersected.
    std::vector<RelaxLevel> relaxation = {};  //!< Empty: the sites were not relaxed.
    //! Components whose cells did not give their topology: they were thinned to their sites instead
    //! (thin).
    Index components_thinned = 0;
    FeatureCounts features = {};    //!< What became of creases.
    JunctionCounts junctions = {};  //!< What became of junctions.
    SizingResult sizing = {};       //!< How long the edges are.
    DelaunayCounts delaunay = {};   //!< Edges that failed, were flipped, still fail.
    //! Intersecting pairs of faces of the result and, if that is not 0, of the cleaned input.
    //! Sheets that touch at a junction with equal points do not count. Unset: without CGAL.
    std::optional<Index> self_intersections = {};
    Index input_self_intersections = 0;  //!< See self_intersections.
    //! Pairs of the result that intersect farther from all places where the input intersects itself
    //! than their longest edge. Others follow from the input; more samples give more of these. 0 if
    //! the input has as many pairs as the result. With a region: those above their number.
    Index new_self_intersections = 0;
    Verdict verdict = {};  //!< What the result is too coarse to show.
    //! Of the last propagation: see Propagation. Infinity: nothing is certified.
    double certified_error = std::numeric_limits<double>::infinity();
    std::size_t propagation_bytes = 0;  //!< Peak of the last propagation, beyond the mesh.
    std::vector<std::pair<Stage, double>> seconds = {};  //!< Wall time spent in each stage.
};

}  // namespace remesh
