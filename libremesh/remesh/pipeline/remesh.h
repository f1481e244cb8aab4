//! \file
//! The whole pipeline, options in and result out: from a mesh to the dual of its geodesic Voronoi
//! diagram, with the topology of the cleaned input.
//! Held by TopologyGuarantee.* in tests/remesh/pipeline.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/topology.h"
#include "agvd/propagation/propagate.h"
#include "remesh/clean/clean_input.h"
#include "remesh/curves/find_creases.h"
#include "remesh/dual/build_dual.h"
#include "remesh/quality/evaluate.h"
#include "remesh/sites/sites.h"
#include "remesh/sites/sizing.h"

namespace remesh {

//! The stages of remesh(); some run more than once.
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

//! The number of vertices if the topology needs more sites.
enum class VertexCount {
    Exact,  //!< As many vertices as sites were asked for: others are removed.
    Raise,  //!< Exact; if no mesh has so few, another number is tried, until one is found.
    Add,    //!< Vertices that the topology needs are added; the number is raised likewise.
};

//! How distances are computed: the fields of PropagationOptions that a remesh has.
struct EngineOptions {
    Engine engine = PropagationOptions{}.engine;  //!< See PropagationOptions, as the others.
    //! With 0 the run works on the input itself, however many faces it has for each sample;
    //! otherwise maybe on a coarse surface (RemeshResult::coarse_faces).
    std::optional<double> max_error = {};
    int steiner_points = PropagationOptions{}.steiner_points;  //!< See engine.
    double lambda = PropagationOptions{}.lambda;               //!< See engine.

    //! The same for propagate().
    [[nodiscard]] PropagationOptions for_propagation(int num_threads, Progress progress) const {
        return {.engine = engine,
                .max_error = max_error,
                .steiner_points = steiner_points,
                .lambda = lambda,
                .num_threads = num_threads,
                .progress = std::move(progress)};
    }
};

//! All lengths in mesh units. `{}` gives a good result.
struct RemeshOptions {
    Index num_samples = 2000;  //!< Sites to place, >= 1: one output vertex each.
    //! How the input is repaired. Its num_threads and progress are ignored: those below count.
    CleanOptions cleaning = {};
    //! The radius of balls, mesh units, >= 0: what is remeshed is the outside of the mesh as far as
    //! they can reach it, one closed surface for each part, without intersections, whatever the
    //! mesh. Holes and gaps narrower than 1.6 radii are closed, those wider than two are not; what
    //! lies inside is gone; an open
    //! sheet gets two sides. 0: half the spacing of the samples, which makes it quick; solids whose
    //! union has no gaps of that width are united exactly in place of that. Labels and
    //! lengths are those of the nearest face; texture_seams do not count. Needs CGAL. Not with
    //! `sites`, feature_edges, locked elements, a region or MaxDistance.
    std::optional<double> wrap = {};
    //! How long edges are, and where. Some of its fields decide the number of samples instead.
    Sizing sizing = {};
    VertexCount vertex_count = VertexCount::Exact;  //!< What gives way.
    //! Keep: boundary vertices lie on the input's boundary. Free: `fit` may move them off it, and
    //! given sites need not lie on it.
    Boundary boundary = Boundary::Keep;
    //! Angles and edges of all triangles. With a longest edge the result has as many more vertices
    //! as it needs. With given sites, relax_steps of 0 or junctions they are only checked. With a
    //! region they are about the faces in it.
    ShapeBounds bounds = {};
    double drop_components = 0;  //!< In [0, 1]: smaller components (share of the area) are dropped.
    Init init = Init::BlueNoise;  //!< How sites are sampled.
    //! Creases become chains of edges, and their corners become vertices. Given sites on a crease
    //! become its vertices; creases with too few of them are dropped: see plan_given_network.
    Features features = Features::Auto;
    double feature_angle = CreaseOptions{}.angle;  //!< Degrees, in (0, 180): see CreaseOptions.
    //! Edges that are creases whatever their angle, as pairs of the caller's vertices. With
    //! Features::Off only these and the borders of face_labels are creases.
    std::vector<std::array<Index, 2>> feature_edges = {};
    //! A label for each of the caller's faces, or empty. Edges between different labels are creases
    //! like feature_edges.
    std::vector<Index> face_labels = {};
    //! Edges that become curves like feature_edges where the spacing permits, as pairs of the
    //! caller's vertices: see find_texture_seams. Creases come first: if no mesh with both is
    //! found, seams are left out.
    std::vector<std::array<Index, 2>> texture_seams = {};
    //! Whether the sheets of the input's non-manifold edges are welded in the result. Either way
    //! the sheets have equal points there, except with given sites or Boundary::Free.
    Junctions junctions = Junctions::Apart;
    //! Vertices of the caller that stay where they are, bit for bit, as vertices of the result;
    //! those that cleaning welds (clean_input), at their common position. Not with `sites`.
    std::vector<Index> locked = {};
    //! Edges that stay edges of the result, as pairs of the caller's vertices; their ends stay too.
    std::vector<std::array<Index, 2>> locked_edges = {};
    //! The edges of the boundary stay like locked_edges; those of non-manifold edges do not count.
    bool lock_boundary = false;
    //! Faces to remesh: other than 0 for each of the caller's faces that is to change, or empty for
    //! all. The others stay, see KeptPart; what joins them to the changed ones is locked.
    //! num_samples, edge lengths and numbers of faces count in the region, its rim included. Not
    //! with `sites`, drop_components, weld or fill_holes.
    std::vector<std::uint8_t> region = {};
    std::uint64_t seed = 1;  //!< Same seed, same bytes, any num_threads.
    //! Sites on the caller's mesh, instead of sampling; num_samples, init and seed are ignored.
    //! Faces are the caller's.
    std::optional<std::vector<SurfacePoint>> sites = {};
    //! Steps of relaxation, >= 0 (0: the sites stay where they were sampled, as in the paper). With
    //! blue noise relaxation runs coarse to fine, with this many steps on each of two levels.
    int relax_steps = RelaxOptions{}.steps;
    bool keep_sites = false;  //!< Given sites are not relaxed.
    //! Results of more than 5/4 as many samples are made in tiles of at most so many: less memory,
    //! and threads work side by side. 500 or more, or 0: in one piece. Only where sites are
    //! relaxed, edges equally long, and there are no given sites, locked elements, junctions, nor
    //! Boundary::Free.
    Index samples_per_tile = 10'000;
    //! Whether vertices may leave the surface so that the triangles lie nearer to it. Unset: only
    //! if sites are relaxed.
    std::optional<bool> fit = {};
    EngineOptions propagation = {};  //!< How distances are computed.
    //! Which edges to flip: those that fail by geodesic or by straight lengths, or none.
    Delaunay delaunay = DelaunayOptions{}.mode;
    int num_threads = 0;  //!< >= 0; 0: all cores.
    //! Gets the stage and a fraction in [0, 1] on the caller's thread; return false to stop. That
    //! of the whole run: see overall_fraction().
    std::function<bool(Stage, double)> progress = {};
};

//! What became of the creases.
struct FeatureCounts {
    Index curves = 0;    //!< Chains between nodes, and closed chains; the boundary's included.
    Index nodes = 0;     //!< Points where curves turn sharply, end or meet.
    Index vertices = 0;  //!< Vertices of the result on curves and nodes.
    double length = 0;   //!< Of the creases that were kept, in mesh units.
    //! Of creases that run closer to others, or to the boundary, than sites can: only the stronger
    //! ones are kept.
    double close_length = 0;
    double dropped_length = 0;  //!< Of the dropped creases: the sites are too few or lie elsewhere.
    //! Of edges on creases that gave way, as faces there would intersect or have no area.
    double freed_length = 0;
    Vec3 freed_near = Vec3::Zero();  //!< The middle of the longest of these edges.
    Index uncarried_curves = 0;      //!< Creases that given sites do not lie on.
    Index samples_for_all = 0;       //!< Fewest samples that keep all creases.
    //! All creases were dropped, because no mesh with them was found.
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
    //! The target at each vertex of the result. Empty: all are equal, or there is a region.
    std::vector<double> targets = {};
    //! Both ways between result and input, at many points of each; all others are proved to be
    //! within that of MaxDistance. 0: not measured, as that is not used.
    double largest_distance = 0;
};

//! A triangle whose angles exceed RemeshOptions::bounds, as the input forces it: between curves
//! that meet at an acute corner, or are closer than the edges.
struct ForcedFace {
    Index face = 0;        //!< Of the result.
    double min_angle = 0;  //!< Degrees.
    double max_angle = 0;  //!< Degrees.
};

//! What a run with RemeshOptions::region left as it was. Vertices and faces of the result that are
//! not listed come after those that are. Empty: the whole mesh was remeshed.
struct KeptPart {
    std::vector<Index> vertices;  //!< The caller's, ascending: the first ones of the result.
    std::vector<Index> faces;     //!< The caller's, ascending: the first ones of the result.
    Index rim_edges = 0;          //!< Edges between kept and remeshed faces.
};

//! The outside of the mesh with RemeshOptions::wrap.
struct WrapCounts {
    double radius = 0;  //!< Of the balls, in mesh units; 0: solids were united, if there are faces.
    Index faces = 0;    //!< Of the surface that was remeshed; 0: without RemeshOptions::wrap.
    //! The share of its area that keeps a distance from the mesh, as its two sides would meet
    //! there: of sheets.
    double sheets = 0;
};

//! Pairs of faces of a result that intersect.
struct CrossingCounts {
    Index all = 0;    //!< See RemeshResult::self_intersections.
    Index added = 0;  //!< See RemeshResult::new_self_intersections.
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
    WrapCounts wrapped = {};          //!< With RemeshOptions::wrap.
    CleanCounts cleaned;              //!< What cleaning repaired.
    double welded_slit_length = 0;    //!< See CleanResult::slit_length.
    Index loose_vertices = 0;         //!< See CleanResult.
    Topology input_topology;          //!< Of the cleaned input.
    Index refined_faces = 0;          //!< Faces of the base, on which propagation runs.
    Index components_dropped = 0;     //!< See drop_components.
    Index sites_dropped = 0;          //!< Given sites that own nothing (e.g. duplicates).
    Index unfitted_vertices = 0;      //!< Moved back onto the surface: triangles intersected.
    std::vector<RelaxLevel> relaxation = {};  //!< Empty: the sites were not relaxed.
    FeatureCounts features = {};              //!< What became of creases.
    JunctionCounts junctions = {};            //!< What became of junctions.
    SizingResult sizing = {};                 //!< How long the edges are.
    std::vector<ForcedFace> forced = {};      //!< Ascending; all others keep the bounds.
    DualCounts dual = {};                     //!< Where triangles come from.
    DelaunayCounts delaunay = {};             //!< Edges that failed, were flipped, still fail.
    //! Intersecting pairs of faces of the result and, if that is not 0, of the cleaned input.
    //! Sheets that touch at a junction with equal points do not count. Unset: without CGAL.
    std::optional<Index> self_intersections = {};
    Index input_self_intersections = 0;  //!< See self_intersections.
    //! Pairs of the result that intersect farther from all points where the input intersects itself
    //! than their longest edge. Others follow from the input; more samples give more of these. 0 if
    //! the input has as many pairs as the result. With a region: those above their number.
    Index new_self_intersections = 0;
    Vec3 crossing_near = Vec3::Zero();  //!< Where one of them is, if there are any.
    Verdict verdict = {};               //!< What the result is too coarse to show.
    //! Of the last propagation: see Propagation. Infinity: nothing is certified.
    double certified_error = std::numeric_limits<double>::infinity();
    //! Faces of the coarse surface that stood for the input (docs/algorithm/input.md); 0: none did.
    Index coarse_faces = 0;
    Index tiles = 0;                    //!< In which the surface was meshed; 0: in one piece.
    std::size_t propagation_bytes = 0;  //!< Peak of the last propagation beyond the mesh.
    std::vector<std::pair<Stage, double>> seconds = {};  //!< Wall time spent in each stage.
};

//! Replaces a mesh by the dual of its geodesic Voronoi diagram ([meng2023] Sec. 7).
//!
//! The result is an oriented 2-manifold with the components of the cleaned input, each with its
//! genus and boundary loops, and has num_samples vertices (or one for each of `sites` that owns a
//! part of the surface). Both are checked; docs/algorithm/dual.md says why they can be had. Where k
//! sheets meet at a junction, it has k vertices at one point; Junctions::Keep welds them.
//! \param mesh  #V x 3 positions, #F x 3 indices; read only during the call; may be dirty.
//! \throw InvalidOption    an option is out of range.
//! \throw InvalidInput the mesh cannot be repaired (see clean_input), a given site does not
//!        lie on it, or a feature edge is not one of its edges.
//! \throw ConstraintUnmet  num_samples is too small for the topology; the text gives a number
//!        that was tried and works. Or a bound is not kept; the text names the worst triangle.
//! \throw Cancelled        the progress callback returned false.
//! Cost: O(n log n) in practice, n = faces of the base + samples. With 2000 samples relaxation
//! takes some 40 % of it, placement and improvement 30 %, propagation and diagram 15 to 20 %.
//! Propagation is O(n sqrt(n / t)) for exact distances, t = sites; the Steiner engine has O(m n)
//! nodes, m = Steiner points per edge. Re-entrant: no global state.
[[nodiscard]] RemeshResult remesh(const MeshView& mesh, const RemeshOptions& options = {});

//! The same for a mesh that the caller no longer needs. If it needs no repair and no option refers
//! to its elements, its memory, 36 bytes for each face, is released after cleaning.
[[nodiscard]] RemeshResult remesh_moved(TriangleMesh mesh, const RemeshOptions& options = {});

//! About how much of a run is done where a stage has reached this fraction, in [0, 1]: for a bar of
//! the whole run, by the times of usual runs. It falls where stages are run again.
//! \param fraction   as RemeshOptions::progress gets it.
//! \param num_faces  of the mesh that is remeshed.
//! \param options    those of the run; num_samples is a guess where sizing decides it.
[[nodiscard]] double overall_fraction(Stage stage, double fraction, std::size_t num_faces,
                                      const RemeshOptions& options);

}  // namespace remesh
