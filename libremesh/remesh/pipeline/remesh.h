//! \file
//! The whole job: a mesh in, the dual of its geodesic Voronoi diagram out.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "agvd/propagation/propagate.h"
#include "remesh/dual/delaunay.h"
#include "remesh/features/find_creases.h"
#include "remesh/features/junctions.h"
#include "remesh/quality/topology.h"
#include "remesh/relax/relax_sites.h"
#include "remesh/repair/clean_input.h"
#include "remesh/sampling/sample_sites.h"

namespace remesh {

enum class Stage { Clean, Sample, Relax, Propagate, Diagram, Dual, Delaunay, Place, Check };

//! Lower-case name of a stage, for logs.
[[nodiscard]] const char* stage_name(Stage stage);

//! Which creases are kept.
enum class Features {
    Auto,   //!< Those that are long and strong enough for the spacing of the sites.
    Angle,  //!< All above feature_angle.
    Off
};

//! Lower-case name of a choice: "auto", "angle" or "off".
[[nodiscard]] const char* features_name(Features features);

//! What became of the creases.
struct FeatureCounts {
    agvd::Index curves = 0;     //!< Chains between nodes, and closed ones; the boundary's included.
    agvd::Index nodes = 0;      //!< Corners, ends and junctions.
    agvd::Index vertices = 0;   //!< Of the result, on curves and nodes.
    double length = 0;          //!< Of the creases that were kept, mesh units.
    double dropped_length = 0;  //!< Of those for which the sites are too few, or lie elsewhere.
    agvd::Index uncarried_curves = 0;  //!< Creases that given sites do not lie on.
    agvd::Index samples_for_all = 0;   //!< Fewest with which all are kept.
    agvd::Index thinned_patches = 0;   //!< Parts between curves too narrow for Voronoi cells.
    //! Creases were dropped as no mesh with all of them was found, or only such as run through
    //! themselves.
    bool gave_up = false;
};

//! What became of the edges that more than two faces share in the input.
struct JunctionCounts {
    agvd::Index edges = 0;     //!< Of the cleaned input, those of several sheets counted once.
    agvd::Index curves = 0;    //!< Chains of them between nodes, and closed ones.
    agvd::Index vertices = 0;  //!< Of the result, on these.
    //! Edges of the input along which each sheet got points of its own: no mesh with the same ones
    //! was found, or the options do not allow for it.
    agvd::Index apart_edges = 0;
    agvd::Index samples_for_all = 0;  //!< No fewer have the same points everywhere.
    agvd::Index welded_edges = 0;     //!< Edges of the result with more than two faces.
};

//! What becomes of the count where the topology asks for more sites.
enum class VertexCount {
    Exact,  //!< As many vertices as sites were asked for: others go where that harms nothing.
    Add,    //!< The sites that repair adds stay.
};

//! All lengths in mesh units. `{}` gives a good result.
struct RemeshOptions {
    agvd::Index num_samples = 2000;  //!< Sites to place, >= 1: one output vertex each.
    VertexCount vertex_count = VertexCount::Exact;
    //! Keep: boundary vertices lie on the input's boundary. Free: near it; beside creases, which
    //! stay where they are, only as far as the result lies nearer to it so.
    Boundary boundary = Boundary::Keep;
    double drop_components = 0;  //!< Leave out components with less than this % of the area.
    Init init = Init::BlueNoise;
    //! Creases become chains of edges, and their corners vertices. Of given sites those on creases
    //! become their vertices, and creases that have too few are dropped: see plan_given_network.
    Features features = Features::Auto;
    double feature_angle = CreaseOptions{}.angle;  //!< Degrees, in (0, 180): see CreaseOptions.
    //! Edges that are creases whatever their angle, as pairs of the caller's vertices; with
    //! Features::Off no others are.
    std::vector<std::array<agvd::Index, 2>> feature_edges = {};
    //! A label for each face of the caller's, or nothing: edges between different ones are creases
    //! as feature_edges are.
    std::vector<agvd::Index> face_labels = {};
    //! Whether the sheets of the input's non-manifold edges are welded in the result. Their points
    //! are the same in any case, but not with given sites, nor with Boundary::Free.
    Junctions junctions = Junctions::Apart;
    std::uint64_t seed = 1;  //!< Same seed, same bytes, any num_threads.
    //! Sites to use instead of sampling, on the caller's mesh; num_samples, init and seed are then
    //! ignored. Faces are the caller's.
    std::optional<std::vector<agvd::SurfacePoint>> sites = {};
    //! Steps of relaxation, >= 0 (0: the sites stay where they were sampled, as in the paper). With
    //! blue noise they run coarse to fine, so many on each of two levels.
    int relax_steps = RelaxOptions{}.steps;
    bool keep_sites = false;  //!< Given sites are not relaxed.
    //! Vertices may leave the surface so that the triangles lie nearer to it. Unset: if sites are
    //! relaxed.
    std::optional<bool> fit = {};
    agvd::Engine engine = agvd::PropagationOptions{}.engine;
    //! Relative distance error, in [0, 1), 0: exact; unset: see agvd::PropagationOptions.
    std::optional<double> max_error = {};
    int steiner_points = 8;  //!< Steiner engine, m: Steiner points on each edge, in [0, 1000].
    double lambda = 1;       //!< Steiner engine: triangles are retired every lambda * #F pops, > 0.
    int repair_rounds = 12;  //!< Rounds of adding sites, >= 0; then components are thinned.
    //! Which edges to flip: those that fail by geodesic or by straight lengths, or none.
    Delaunay delaunay = DelaunayOptions{}.mode;
    int num_threads = 0;  //!< >= 0; 0: all cores.
    //! Gets the stage and a fraction in [0, 1] on the caller's thread; return false to stop.
    std::function<bool(Stage, double)> progress = {};
};

//! Plain values owned by the caller; nothing points back into the input.
struct RemeshResult {
    //! Oriented 2-manifold with the topology of the cleaned input; with Junctions::Keep, its sheets
    //! welded at junctions.
    agvd::TriangleMesh mesh;
    std::vector<agvd::SurfacePoint> sites;  //!< One per output vertex: where it lies on the input
                                            //!< (faces are the caller's).
    CleanCounts cleaned;                    //!< What was repaired on the input before.
    Topology input_topology;                //!< Of the cleaned input.
    agvd::Index refined_faces = 0;          //!< Faces that propagation saw, long edges split.
    agvd::Index components_dropped = 0;     //!< See drop_components.
    agvd::Index sites_added = 0;            //!< By topology repair and against self-intersections.
    std::map<std::string, agvd::Index> added_because = {};  //!< The same by reason.
    agvd::Index sites_moved = 0;        //!< Onto the boundary, or from where they owned nothing.
    agvd::Index sites_removed = 0;      //!< Vertices taken away to keep the count.
    agvd::Index sites_dropped = 0;      //!< Given sites that own nothing (e.g. duplicates).
    int repair_rounds = 0;              //!< Rounds of moving and adding.
    agvd::Index unfitted_vertices = 0;  //!< Back on the surface: triangles met there.
    std::vector<RelaxLevel> relaxation = {};  //!< Empty: the sites were not relaxed.
    //! Components whose cells could not be made to give their topology: the surface was thinned to
    //! their sites instead (agvd::thin).
    agvd::Index components_from_faces = 0;
    FeatureCounts features = {};
    JunctionCounts junctions = {};
    DelaunayCounts delaunay = {};  //!< Edges that failed, were flipped, still fail.
    //! Self-intersecting pairs of faces of the result, and, if that is not 0, of the cleaned input.
    //! That sheets touch at a junction does not count where they have the same points there. Unset:
    //! without CGAL.
    std::optional<agvd::Index> self_intersections = {};
    agvd::Index input_self_intersections = 0;
    //! Of the last propagation: see agvd::Propagation. Infinity: nothing is certified.
    double certified_error = std::numeric_limits<double>::infinity();
    std::size_t propagation_bytes = 0;  //!< Peak of the last propagation, beyond the mesh.
    std::vector<std::pair<Stage, double>> seconds = {};  //!< Wall time spent in each stage.
};

//! Replaces a mesh by the dual of its geodesic Voronoi diagram ([meng2023] Sec. 7).
//!
//! The result is an oriented 2-manifold with the components of the cleaned input, each with its
//! genus and boundary loops, and with num_samples vertices (or those of `sites` that own
//! something): checked before it is returned. A junction of k sheets has k vertices at one point;
//! with Junctions::Keep the mesh is one of these sheets, welded. docs/algorithm.md says why this
//! always ends well. \param mesh  #V x 3 positions, #F x 3 indices; read only during the call; may
//! be dirty. \throw agvd::InvalidOption    an option is out of range. \throw agvd::InvalidInput the
//! mesh cannot be repaired (see clean_input), a given site is not
//!        on it, or a feature edge is none of its edges.
//! \throw agvd::ConstraintUnmet  num_samples is too small for the topology; the text gives a number
//!        that was tried and works.
//! \throw agvd::Cancelled        the progress callback returned false.
//! Cost: O(m n log n) a round, n = #F. Re-entrant: no global state.
[[nodiscard]] RemeshResult remesh(const agvd::MeshView& mesh, const RemeshOptions& options = {});

//! The same for a mesh that the caller does not need any more: where nothing has to be repaired its
//! memory, 36 bytes for each face, is given back before all else is made.
[[nodiscard]] RemeshResult remesh_moved(agvd::TriangleMesh mesh, const RemeshOptions& options = {});

}  // namespace remesh
