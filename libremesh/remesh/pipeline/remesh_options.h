//! \file
//! What remesh() can be asked for.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "agvd/mesh/surface_point.h"
#include "agvd/propagation/propagation_options.h"
#include "remesh/dual/delaunay.h"
#include "remesh/features/find_creases.h"
#include "remesh/features/junctions.h"
#include "remesh/relax/relax_options.h"
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
    double drop_components = 0;  //!< In [0, 1]: components with a smaller share of the area go.
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
    //! How distances are found that cells come from. num_threads and progress are those below.
    agvd::PropagationOptions propagation = {};
    int repair_rounds = 12;  //!< Rounds of adding sites, >= 0; then components are thinned.
    //! Which edges to flip: those that fail by geodesic or by straight lengths, or none.
    Delaunay delaunay = DelaunayOptions{}.mode;
    int num_threads = 0;  //!< >= 0; 0: all cores.
    //! Gets the stage and a fraction in [0, 1] on the caller's thread; return false to stop.
    std::function<bool(Stage, double)> progress = {};
};

}  // namespace remesh
