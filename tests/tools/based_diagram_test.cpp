// Diagrams of the programs, which are made on a base and drawn on the input.
#include "based_diagram.h"

#include <gtest/gtest.h>

#include "agvd/mesh/surface_points.h"
#include "support/line_sites.h"
#include "support/points.h"

using namespace agvd;

// In a plane, with starts: the base's faces are not those of the mesh, so bisectors cross edges
// between points of their arcs.
TEST(BasedDiagram, HasPointsOfExactBisectorsOnEdgesOfTheMesh) {
    const Surface surface = line_sites::uneven_square(24, 3);
    const std::vector<SurfacePoint> sites = points::scattered(surface, 13, 5);
    PropagationOptions options{.max_error = 0};
    for (std::size_t i = 0; i < sites.size(); ++i) {
        options.points.start.push_back(0.005 * static_cast<double>(i * 7 % 13));
    }
    const auto silent = [](const char*) { return Progress(); };
    const Diagram diagram = cli::based_diagram(surface, sites, options, silent).diagram;
    EXPECT_TRUE(diagram.arcs.empty() && diagram.edge_arcs.empty());
    const MeshView mesh = surface.mesh.view();
    int num_on_edges = 0;
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const auto [left, right, tail, head] = diagram.edges[e];
        if (!right.is_valid()) continue;
        for (Index i = diagram.edge_points[e]; i < diagram.edge_points[e + 1]; ++i) {
            const Vec3 p = position(mesh, diagram.points[i]);
            for (const SiteId site : {left, right}) {
                const Index s = site.value();
                EXPECT_NEAR(options.points.start[s] + (p - position(mesh, sites[s])).norm(),
                            diagram.point_distance[i], 1e-11);
            }
            num_on_edges += half_edge_of(diagram.points[i]) ? 1 : 0;
        }
    }
    EXPECT_GT(num_on_edges, 200);
}
