#include <CGAL/alpha_wrap_3.h>

#include "agvd/core/error.h"
#include "remesh/wrap/cgal_mesh.h"
#include "remesh/wrap/wrap.h"

namespace remesh::detail {
namespace {

// Polls once for each facet that is looked at.
struct PollingVisitor : CGAL::Alpha_wraps_3::internal::Wrapping_default_visitor {
    Ticker* ticker;

    explicit PollingVisitor(Ticker& polling) : ticker(&polling) {}
    template <typename Wrapper, typename Gate>
    void before_facet_treatment(const Wrapper&, const Gate&) {
        ticker->tick(steps_of_facet);
    }
    static constexpr std::size_t steps_of_facet = 1 << 8;
};

}  // namespace

TriangleMesh alpha_wrap(const MeshView& mesh, double radius, const Progress& progress) {
    std::vector<CgalKernel::Point_3> points;
    points.reserve(mesh.positions.size());
    for (const Vec3& p : mesh.positions) points.emplace_back(p.x(), p.y(), p.z());
    std::vector<Triangle> with_area;
    with_area.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
        if (!CGAL::collinear(points[t[0]], points[t[1]], points[t[2]])) with_area.push_back(t);
    }
    if (with_area.empty()) {
        throw InvalidInput(
            "the mesh has no face with an area; check that the file holds a surface");
    }
    Poller poller(progress);
    Ticker ticker(poller);
    PollingVisitor visitor(ticker);
    CgalMesh wrap;
    // CGAL's balls touch the vertices of the wrap, not the mesh.
    const double offset = wrap_offset * radius;
    CGAL::alpha_wrap_3(points, with_area, radius - offset, offset, wrap,
                       CGAL::parameters::default_values(), CGAL::parameters::visitor(visitor));
    return to_triangle_mesh(wrap);
}

}  // namespace remesh::detail
