#include "agvd/core/error.h"
#include "bench/exact.h"

namespace bench {
namespace {

using namespace agvd;

[[noreturn]] void refuse() {
    throw InvalidOption("exact distances need CGAL; build with -DAGVD_WITH_CGAL=ON");
}

}  // namespace

bool has_exact() { return false; }

std::vector<double> exact_vertex_distances(const Surface& /*surface*/,
                                           std::span<const SurfacePoint> /*sites*/) {
    refuse();
}

std::vector<double> vertex_distances_by_one_search(const Surface& /*surface*/,
                                                   std::span<const SurfacePoint> /*sites*/) {
    refuse();
}

std::vector<LabelError> exact_label_errors(const Surface& /*surface*/,
                                           std::span<const SurfacePoint> /*sites*/,
                                           std::span<const SurfacePoint> /*points*/,
                                           std::span<const std::vector<SiteId>> /*labels*/) {
    refuse();
}

}  // namespace bench
