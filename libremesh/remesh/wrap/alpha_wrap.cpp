#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include "agvd/core/error.h"
#include "remesh/wrap/wrap.h"

namespace remesh::detail {
namespace {

using WrapKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using WrapMesh = CGAL::Surface_mesh<WrapKernel::Point_3>;

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
    std::vector<WrapKernel::Point_3> points;
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
    WrapMesh wrap;
    // CGAL's balls touch the vertices of the wrap, not the mesh.
    const double offset = wrap_offset * radius;
    CGAL::alpha_wrap_3(points, with_area, radius - offset, offset, wrap,
                       CGAL::parameters::default_values(), CGAL::parameters::visitor(visitor));
    TriangleMesh result;
    result.positions.reserve(wrap.number_of_vertices());
    for (const auto v : wrap.vertices()) {
        const auto& p = wrap.point(v);
        result.positions.emplace_back(p.x(), p.y(), p.z());
    }
    result.triangles.reserve(wrap.number_of_faces());
    for (const auto f : wrap.faces()) {
        Triangle corners{};
        std::size_t k = 0;
        for (const auto v : wrap.vertices_around_face(wrap.halfedge(f))) corners[k++] = v.idx();
        result.triangles.push_back(corners);
    }
    return result;
}

}  // namespace remesh::detail
