//! \file
//! The options of remesh().
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "agvd/mesh/mesh.h"
#include "agvd/propagation/propagate.h"
#include "remesh/clean/clean_input.h"
#include "remesh/curves/find_creases.h"
#include "remesh/dual/build_dual.h"
#include "remesh/sites/relax_sites.h"
#include "remesh/sites/sample_sites.h"
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
    Add,    //!< Sites that repair adds become vertices as well.
};

//! All lengths in mesh units. `{}` gives a good result.
struct RemeshOptions {
    Index num_samples = 2000;  //!< Sites to place, >= 1: one output vertex each.
    //! How the input is repaired. Its num_threads and progress are ignored: those below count.
    CleanOptions cleaning = {};
    //! How long edges are, and where. Some of its fields decide the number of samples instead.
    Sizing sizing = {};
    VertexCount vertex_count = VertexCount::Exact;  //!< What gives way.
    //! Keep: boundary vertices lie on the input's boundary. Free: they lie near it; if creases are
    //! kept, only `fit` moves vertices off the boundary.
    Boundary boundary = Boundary::Keep;
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
    //! those that cleaning welds (clean_input), at their common place. Not with `sites`.
    std::vector<Index> locked = {};
    //! Edges that stay edges of the result, as pairs of the caller's vertices; their ends stay too.
    std::vector<std::array<Index, 2>> locked_edges = {};
    //! The edges of the boundary stay like locked_edges; those of non-manifold edges do not count.
    bool lock_boundary = false;
    //! Faces to remesh: other than 0 for each of the caller's faces that is to change, or empty for
    //! all. The others stay, see KeptPart; what joins them to the changed ones is locked.
    //! num_samples, edge lengths and numbers of faces count in the region, its seam included. Not
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
    //! Whether vertices may leave the surface so that the triangles lie nearer to it. Unset: only
    //! if sites are relaxed.
    std::optional<bool> fit = {};
    //! How distances are computed. Its num_threads and progress are ignored: those below count.
    PropagationOptions propagation = {};
    //! Most rounds that add sites, >= 0; components that still fail are thinned.
    int repair_rounds = 12;
    //! Which edges to flip: those that fail by geodesic or by straight lengths, or none.
    Delaunay delaunay = DelaunayOptions{}.mode;
    int num_threads = 0;  //!< >= 0; 0: all cores.
    //! Gets the stage and a fraction in [0, 1] on the caller's thread; return false to stop.
    std::function<bool(Stage, double)> progress = {};
};

}  // namespace remesh
