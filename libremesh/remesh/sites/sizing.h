//! \file
//! The options of sizing: how long the edges of the result are, and where.
#pragma once

#include <limits>
#include <vector>

#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh {

//! Lengths in mesh units. Where: at most one of is_adaptive, target_lengths, face_lengths and
//! densities; none: all edges are equally long. How many: at most one of max_error, max_distance,
//! edge_length, num_faces and gives_count; none: lengths are scaled so that
//! RemeshOptions::num_samples vertices come out.
struct Sizing {
    //! Shorter edges where the surface is curved, as the cubic root of the radius of curvature: the
    //! RMS distance of the result is least.
    bool is_adaptive = false;
    //! > 0: lengths of adaptive edges are those of length_for_error instead, and the number of
    //! samples follows. 0: not used.
    double max_error = 0;
    //! > 0: the result and the input lie no farther from each other; the number of samples follows,
    //! and edges are adaptive. 0: not used.
    double max_distance = 0;
    std::vector<double> target_lengths = {};  //!< > 0, for each of the caller's vertices; or empty.
    //! > 0, for each of the caller's faces; or empty. Where faces meet, the least counts.
    std::vector<double> face_lengths = {};
    std::vector<double> densities = {};  //!< As target_lengths: vertices per area, in any unit.
    double min_edge = 0;                 //!< >= 0: no target is shorter ...
    double max_edge = std::numeric_limits<double>::infinity();  //!< ... or longer.
    //! >= 1. Over a distance d targets grow by at most d times its logarithm.
    double gradation = 1.3;
    //! > 0: the mean edge of the result; the number of samples follows. 0: not used.
    double edge_length = 0;
    //! > 0: faces of the result, up to a few along the boundary. 0: not used.
    Index num_faces = 0;
    //! The number of samples follows from target_lengths or face_lengths, not scaled.
    bool gives_count = false;
};

//! Whether all edges have one target.
[[nodiscard]] inline bool is_uniform(const Sizing& sizing) {
    return !sizing.is_adaptive && sizing.target_lengths.empty() && sizing.face_lengths.empty() &&
           sizing.densities.empty();
}

}  // namespace remesh
