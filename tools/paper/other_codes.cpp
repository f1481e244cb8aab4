#include "paper/other_codes.h"

#include "bench/exact.h"
#include "bench/workload.h"

namespace bench {

#ifdef AGVD_HAS_PAPER_CODES
namespace {

template <auto distances>
std::vector<double> from_corners(const agvd::Surface& surface,
                                 std::span<const agvd::SurfacePoint> sites) {
    FlatMesh mesh;
    for (const agvd::Vec3& p : surface.mesh.positions) {
        mesh.coordinates.insert(mesh.coordinates.end(), {p.x(), p.y(), p.z()});
    }
    for (const agvd::Triangle& t : surface.mesh.triangles) {
        mesh.corners.insert(mesh.corners.end(), t.begin(), t.end());
    }
    std::vector<agvd::Index> sources;
    for (const agvd::SurfacePoint& site : sites) sources.push_back(nearest_corner(surface, site));
    return distances(mesh, sources);
}

}  // namespace
#endif

std::vector<OtherCode> other_codes() {
    std::vector<OtherCode> codes;
    // On a million faces CGAL's windows take more than 13 GB.
    if (has_exact()) codes.push_back({"CGAL, distances", vertex_distances_by_one_search, 500'000});
#ifdef AGVD_HAS_PAPER_CODES
    codes.push_back({"MMP, distances", from_corners<mmp_distances>});
    codes.push_back({"VTP, distances", from_corners<vtp_distances>});
#endif
    return codes;
}

}  // namespace bench
