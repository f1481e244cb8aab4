//! \file
//! One mesh and set of sites of the paper's evaluation, measured with every method.
#pragma once

#include <nlohmann/json.hpp>

#include "bench/method.h"
#include "bench/workload.h"

namespace bench {

struct PaperCase {
    std::string mesh;
    const agvd::Surface& surface;
    const std::vector<agvd::SurfacePoint>& sites;
};

struct PaperOptions {
    int repetitions = 3;                   //!< >= 1; the quickest counts.
    bool with_errors = true;               //!< Against the exact diagram.
    agvd::Index bisector_points = 50'000;  //!< Most points measured of each diagram.
    bool with_dual = false;  //!< The dual is built, too, and counts as part of the whole.
};

//! A row for each method, all on one thread. Times are in P0 of the same run: the quickest of the
//! repetitions over the quickest sweep beside any of them, both in processor time. Memory is the
//! peak of what `new` allocates beyond the mesh. Errors are those of compare_diagrams and
//! exact_bisector_errors.
//!
//! Keys: mesh, faces, sites, method, p0_ms, propagate_p0, diagram_p0, dual_p0, total_p0, total_ms,
//! peak_mb, bytes_per_face, delta_percent, frechet_radii, unmatched_loops, hausdorff_radii,
//! wrong_percent, mean_bisector_error, p95_bisector_error, max_bisector_error.
[[nodiscard]] std::vector<nlohmann::ordered_json> measure(const PaperCase& c,
                                                          const std::vector<Method>& methods,
                                                          const PaperOptions& options);

}  // namespace bench
