//! \file
//! Compares a remeshed surface with the original.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "agvd/mesh/topology.h"
#include "remesh/clean/clean_input.h"
#include "remesh/quality/feature_coverage.h"
#include "remesh/quality/surface_distance.h"
#include "remesh/quality/triangle_quality.h"

namespace remesh {

//! The distance is the only measure with options.
using EvaluationOptions = DistanceOptions;

//! One mesh by itself.
struct MeshFigures {
    Index vertices = 0;         //!< Also those in no face.
    Index faces = 0;            //!< #F.
    Topology topology;          //!< Components, genus, boundary loops.
    TriangleQuality triangles;  //!< Shapes and sizes.
    //! See find_self_intersections; unset in a build without CGAL.
    std::optional<std::vector<std::pair<Index, Index>>> self_intersections;
};

//! Everything but self-intersections.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n log n).
[[nodiscard]] MeshFigures measure_figures(const MeshView& mesh, const Progress& progress = {});

//! A remesh compared with its original.
struct Evaluation {
    MeshFigures original;        //!< After the repair that remesh() does, with its face numbers.
    CleanCounts cleaned;         //!< What that repair did.
    MeshFigures result;          //!< As given.
    bool topology_kept = false;  //!< The result is an oriented manifold with same_topology().
    std::optional<SurfaceDistance> distance;  //!< Unset in a build without CGAL.
    //! Unset if the original has neither sharp edges nor corners.
    std::optional<FeatureCoverage> features;
    //! Whether the original has creases at the spacing of the result, or of 2000 vertices; or edges
    //! with more than two faces. Otherwise its sharp edges are noise.
    bool has_creases = false;
};

//! \param original  any mesh that remesh() takes; it is repaired first (see clean_input).
//! \param result    any triangles, manifold or not; measured as they are.
//! \throw InvalidOption  see surface_distance.
//! \throw InvalidInput   the original cannot be repaired; or the result has an index out of
//!        range, a coordinate that is not finite, or no face with area. The text begins with
//!        "original: " or "result: ".
//! \throw Cancelled      the progress callback returned false.
//! Cost: O((samples + n) log n): about a second for 70 000 faces each and 200 000 samples.
[[nodiscard]] Evaluation evaluate(const MeshView& original, const MeshView& result,
                                  const EvaluationOptions& options = {});

}  // namespace remesh
