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
    agvd::Index bisector_points = 10'000;  //!< Most points measured of each diagram.
    bool with_dual = false;         //!< The dual is built, too, and counts as part of the whole.
    bool with_other_codes = false;  //!< A row for each of other_codes() that can, run once.
    agvd::Index label_points = 0;   //!< Whose cells are compared with CGAL's nearest sites.
};

//! A row for each method, all on one thread. Times are in P0 of the same run: the quickest of the
//! repetitions over the quickest sweep beside any of them, both in processor time. Memory is the
//! peak of what `new` allocates beyond the mesh; other codes make a mesh of their own, which is
//! part of theirs. Errors are those of compare_diagrams, exact_bisector_errors and compare_labels,
//! the latter at points that are uniform by area.
//!
//! Keys: mesh, faces, sites, method, p0_ms, base_p0, propagate_p0, diagram_p0, dual_p0, total_p0,
//! total_ms, peak_mb, bytes_per_face, delta_percent, frechet_radii, unmatched_loops,
//! hausdorff_radii, wrong_percent, mean_bisector_error, p95_bisector_error, max_bisector_error,
//! wrong_label_percent, largest_label_error (in cell radii), largest_difference (of other codes'
//! distances from the first method's, in cell radii), and of the Steiner engine
//! steiner_points and lambda. Those of what was not measured are absent.
//! \throw agvd::InvalidOption  labels are to be compared, and the build has no CGAL.
[[nodiscard]] std::vector<nlohmann::ordered_json> measure(const PaperCase& c,
                                                          const std::vector<Method>& methods,
                                                          const PaperOptions& options);

}  // namespace bench
