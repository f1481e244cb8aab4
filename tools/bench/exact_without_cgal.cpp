#include "agvd/core/error.h"
#include "bench/exact.h"

namespace bench {

ExactRun run_exact(const agvd::Surface& /*surface*/,
                   std::span<const agvd::SurfacePoint> /*sites*/) {
    throw agvd::InvalidOption("exact distances need CGAL; build with -DAGVD_WITH_CGAL=ON");
}

}  // namespace bench
