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

// The unit square as two faces, a site at each end of the lower side: the bisector crosses that and
// the upper side in their middles. On the diagonal the distances of its ends are 0 and 1.
TEST(VertexLabels, CrossingsAreInterpolatedAlongEdges) {
    const Surface surface = build_surface(shapes::grid(1).view());
    const auto sites = sites_at(surface, {{0, 0, 0}, {1, 0, 0}});
    const Diagram diagram =
        vertex_label_diagram(surface, sites.size(), propagate(surface, sites, {.max_error = 0}));
    const double along =
        (std::numbers::sqrt2 + 1) / 2;  // Of the diagonal, from its end with a site.
    const std::vector<std::pair<double, double>> height_and_distance{
        {0, 0.5}, {1, 1.5}, {along / std::numbers::sqrt2, along}};
    Index num_bisectors = 0;
    for (const VoronoiEdge& edge : diagram.edges) num_bisectors += edge.right.is_valid();
    EXPECT_EQ(num_bisectors, 2u);
    for (const auto& [height, distance] : height_and_distance) {
        const auto is_it = [&, &y = height, &d = distance](Index v) {
            return std::abs(position(surface.mesh.view(), diagram.vertices[v]).y() - y) < 1e-14 &&
                   std::abs(diagram.vertex_distance[v] - d) < 1e-14;
        };
        Index found = 0;
        for (Index v = 0; v < diagram.vertices.size(); ++v) found += is_it(v);
        EXPECT_EQ(found, 1u) << height;
    }
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
