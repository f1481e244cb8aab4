#include "remesh/pipeline/given_sites.h"

#include <string>

#include "agvd/core/error.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/clean/carry.h"

namespace remesh::detail {
namespace {

// Fewer sites may repeat as they like: relaxation parts them.
constexpr std::size_t least_checked = 1000;

void check_repeats(const Surface& surface, std::span<const SurfacePoint> sites) {
    if (sites.size() < least_checked) return;
    const std::size_t distinct = distinct_points(surface, sites).size();
    if (distinct * 2 >= sites.size()) return;
    throw InvalidSites(std::to_string(sites.size()) + " sites were given, but only at " +
                       std::to_string(distinct) + " different points; give each point once");
}

}  // namespace

std::vector<SurfacePoint> given_sites(const CleanedInput& cleaned, const Surface& surface,
                                      const std::vector<SurfacePoint>& sites) {
    std::vector<SurfacePoint> carried =
        to_cleaned(sites, cleaned.given, {surface.mesh.view(), cleaned.face_origin});
    check_repeats(surface, carried);
    return carried;
}

}  // namespace remesh::detail
