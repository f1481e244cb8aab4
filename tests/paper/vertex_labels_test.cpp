#include "paper/vertex_labels.h"

#include <gtest/gtest.h>

#include <numbers>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/propagation/propagate.h"
#include "paper/compare_diagrams.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

std::vector<SurfacePoint> sites_at(const Surface& surface, std::initializer_list<Vec3> places) {
    std::vector<SurfacePoint> sites;
    const ClosestPointTree tree(surface.mesh.view());
    for (const Vec3& place : places) sites.push_back(tree.query(place).point);
    return sites;
}

}  // namespace

// On a plane bisectors are straight, and the crossings of edges are exact: so all is but for faces
// with three labels.
TEST(VertexLabels, OfTwoSitesOnAPlaneAreTheExactDiagram) {
    const Surface surface = build_surface(shapes::jitter(shapes::grid(9), 0, 1).view());
    const auto sites = sites_at(surface, {{0.21, 0.3, 0}, {0.72, 0.6, 0}});
    const Propagation exact = propagate(surface, sites, {.max_error = 0});
    const Diagram labels = vertex_label_diagram(surface, sites.size(), exact);
    Index num_points = 0;
    for (const BisectorSample& sample : bisector_samples(surface, labels)) {
        const Vec3 p = position(surface.mesh.view(), sample.point);
        EXPECT_NEAR((p - position(surface.mesh.view(), sites[0])).norm(),
                    (p - position(surface.mesh.view(), sites[1])).norm(), 1e-8);
        ++num_points;
    }
    EXPECT_GT(num_points, 20u);
    const DiagramDifference difference =
        compare_diagrams(surface, labels, build_diagram(surface, sites, exact));
    EXPECT_EQ(difference.wrong_label_area, 0);
    EXPECT_NEAR(difference.hausdorff, 0, 1e-8);
    EXPECT_EQ(difference.frechet.matched_loops, 2u);
    EXPECT_EQ(difference.frechet.unmatched_loops, 0u);
    EXPECT_LE(difference.frechet.largest, 2 * difference.frechet.spacing);
}

TEST(VertexLabels, ThreeCellsMeetInsideAFace) {
    const Surface surface = build_surface(shapes::grid(1).view());
    const auto sites = sites_at(surface, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    const Diagram diagram =
        vertex_label_diagram(surface, sites.size(), propagate(surface, sites, {.max_error = 0}));
    // Two faces with three labels each; every edge of the boundary has two parts.
    EXPECT_EQ(diagram.edges.size(), 2u * 3 + 4 * 2);
    EXPECT_EQ(diagram.vertices.size(), 2u + 5 + 4);
    const LoopCurves curves = loop_curves(surface, diagram);
    for (Index s = 0; s < 4; ++s) EXPECT_EQ(curves.cell_loops[s + 1] - curves.cell_loops[s], 1u);
}

// The mesh is coarse: it limits what labels of vertices can tell.
TEST(VertexLabels, AreWorseThanTheExactDiagramAndBetterOnAFinerMesh) {
    const auto error_on = [](const TriangleMesh& mesh) {
        const Surface surface = build_surface(mesh.view());
        const auto sites = sites_at(surface, {{1, 0, 0}, {-1, 0.2, 0}, {0, 1, 1}, {0, -1, -0.4}});
        const Propagation exact = propagate(surface, sites, {.max_error = 0});
        return compare_diagrams(surface, vertex_label_diagram(surface, sites.size(), exact),
                                build_diagram(surface, sites, exact))
            .wrong_label_area;
    };
    const double coarse = error_on(shapes::jitter(shapes::sphere(1), 0.05, 2));
    const double fine = error_on(shapes::jitter(shapes::sphere(4), 0.005, 2));
    EXPECT_GT(coarse, 0.003);
    EXPECT_LT(fine, coarse / 4);
}
