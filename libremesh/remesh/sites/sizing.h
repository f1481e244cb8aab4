//! \file
//! The options of sizing: how long the edges of the result are, and where. The result follows them
//! as far as topology and bounds allow. And what no triangle is to exceed.
//! Held by Sizing.EdgesFollowAFieldThatVariesTenfold, Bounds.AllAnglesKeepThem and the other tests
//! of Sizing and Bounds in tests/remesh/pipeline.
#pragma once

#include <array>
#include <variant>
#include <vector>

#include "agvd/core/types.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh {

//! All edges are equally long.
struct EvenEdges {};
//! Shorter edges where the surface is curved, as the cubic root of the radius of curvature: the RMS
//! distance of the result is least.
struct AdaptiveEdges {};
//! > 0, mesh units: for each of the caller's vertices.
struct VertexLengths {
    std::vector<double> values;  //!< One each.
};
//! > 0, mesh units: for each of the caller's faces. Where faces meet, the least counts.
struct FaceLengths {
    std::vector<double> values;  //!< One each.
};
//! > 0, for each of the caller's vertices: vertices per area, in any unit.
struct VertexDensities {
    std::vector<double> values;  //!< One each.
};

//! Lengths are scaled so that RemeshOptions::num_samples vertices come out.
struct NumSamples {};
//! The mean edge of the result has this length.
struct MeanEdge {
    double length = 0;  //!< > 0, mesh units.
};
//! The result has so many faces, up to a few along the boundary.
struct NumFaces {
    Index number = 0;  //!< > 0.
};
//! Lengths are those of length_for_error. Needs AdaptiveEdges.
struct MaxError {
    double error = 0;  //!< > 0, mesh units.
};
//! The result and the input lie no farther from each other, and edges are adaptive. Excludes
//! lengths and densities.
struct MaxDistance {
    double distance = 0;  //!< > 0, mesh units.
};
//! VertexLengths or FaceLengths count as they are, not scaled.
struct CountOfLengths {};

//! A part of the caller's mesh where edges have a length. They grow from there along the surface.
struct SizedPlace {
    std::vector<SurfacePoint> points = {};         //!< In any order.
    std::vector<std::array<Index, 2>> edges = {};  //!< Pairs of vertices.
    std::vector<Index> faces = {};                 //!< With all that lies in them.
    double length = 0;  //!< > 0, mesh units; not scaled to the number of vertices.
    double radius = 0;  //!< >= 0, mesh units: edges have this length so far around it.
};

//! Where edges are how long, and what gives their number. `{}` gives even edges.
struct Sizing {
    //! Where edges are how long.
    std::variant<EvenEdges, AdaptiveEdges, VertexLengths, FaceLengths, VertexDensities> edges = {};
    //! What gives the number of vertices.
    std::variant<NumSamples, MeanEdge, NumFaces, MaxError, MaxDistance, CountOfLengths> count = {};
    //! Where edges are shorter than these lengths say.
    std::vector<SizedPlace> places = {};
    double min_edge = 0;         //!< >= 0, mesh units: no target is shorter ...
    double max_edge = infinity;  //!< ... or longer.
    //! >= 1. Over a distance d targets grow by at most d times its logarithm.
    double gradation = 1.3;

    //! Whether `edges` is EvenEdges; there may be places all the same.
    [[nodiscard]] bool is_even() const { return std::holds_alternative<EvenEdges>(edges); }
    //! Whether `edges` is AdaptiveEdges.
    [[nodiscard]] bool is_adaptive() const { return std::holds_alternative<AdaptiveEdges>(edges); }
};

//! What no triangle is to exceed. Each is a promise: where it cannot be kept there is no result.
//! Angles that the input forces are told: see RemeshResult::forced.
struct ShapeBounds {
    double min_angle = 0;            //!< Degrees, 0 to 30: no angle is smaller.
    double max_angle = 180;          //!< Degrees, 90 to 180: no angle is larger.
    double longest_edge = infinity;  //!< > 0, mesh units: no edge is longer.

    //! Whether an angle is bounded.
    [[nodiscard]] bool has_angles() const { return min_angle > 0 || max_angle < 180; }
    //! Whether anything is bounded.
    [[nodiscard]] bool has_any() const { return has_angles() || longest_edge < infinity; }
};

}  // namespace remesh
