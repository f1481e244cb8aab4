#include "agvd/mesh/check_sites.h"

#include <cmath>
#include <string>

#include "agvd/core/error.h"

namespace agvd {
namespace {

// Barycentric coordinates that come from files or float sums; checked against 1.
constexpr double barycentric_tolerance = 1e-6;

void check_site(const Surface& surface, const SurfacePoint& site, std::size_t index) {
    const auto refuse = [&](const std::string& why) {
        throw InvalidSites("site " + std::to_string(index) + why);
    };
    if (site.face.value() >= surface.num_faces()) {
        refuse(" names a face that does not exist; use one of the " +
               std::to_string(surface.num_faces()) + " faces, counted from 0");
    }
    double sum = 0;
    for (const double b : site.barycentric) {
        if (!(b >= 0)) {
            refuse(" has barycentric coordinates of which one is negative; correct them");
        }
        sum += b;
    }
    if (!(std::abs(sum - 1) <= barycentric_tolerance)) {
        refuse(" has barycentric coordinates that do not sum to 1; correct them");
    }
}

}  // namespace

void check_sites(const Surface& surface, std::span<const SurfacePoint> sites) {
    for (Index s = 0; s < sites.size(); ++s) check_site(surface, sites[s], s);
}

}  // namespace agvd
