#include "remesh/dual/build_dual.h"

#include <gtest/gtest.h>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/topology.h"
#include "agvd/propagation/propagate.h"
#include "remesh/curves/glue.h"
#include "remesh/sites/relax_network.h"
#include "support/shapes.h"

using agvd::Index;

namespace {

// Three cells meet at one vertex, four at another, two and the outside at the third.
TEST(BuildDual, AVertexOfKCellsGivesTwoTrianglesLess) {
    agvd::Diagram diagram;
    diagram.vertex_offsets = {0, 3, 7, 10};
    for (const Index site : {2u, 0u, 1u, 3u, 4u, 0u, 2u, 5u, 6u}) {
        diagram.vertex_sites.emplace_back(site);
    }
    diagram.vertex_sites.emplace_back();
    diagram.vertices.resize(3);
    EXPECT_EQ(remesh::build_dual(diagram),
              std::vector<agvd::Triangle>({{2, 0, 1}, {3, 4, 0}, {3, 0, 2}}));
}

struct Counts {
    std::size_t faces;  // And edges of the boundary.
    int genus, loops;
    std::size_t components;
};

// Sites that are sampled only, and relaxed ones.
void expect_topology(const agvd::TriangleMesh& mesh, Index num_sites, const Counts& wanted) {
    const agvd::Surface surface = agvd::build_surface(mesh.view());
    const remesh::NetworkPlan plan =
        remesh::plan_network(surface, std::vector<std::uint8_t>(surface.num_edges(), 0), num_sites);
    const remesh::PreparedSurface prepared(plan.cut.surface(),
                                           remesh::mean_spacing(surface, num_sites));
    for (const int steps : {0, 60}) {
        SCOPED_TRACE(std::to_string(num_sites) + " sites, steps: " + std::to_string(steps));
        const auto sites = remesh::sample_network_sites(prepared, plan, {.num_samples = num_sites},
                                                        {.steps = steps})
                               .sites;
        const agvd::Surface& base = prepared.base.surface();
        const auto on_base = prepared.base.to_intrinsic(sites);
        const std::vector<agvd::Triangle> dual =
            remesh::build_dual(agvd::build_diagram(base, on_base, agvd::propagate(base, on_base)));
        const std::vector<agvd::Vec3> positions(sites.size());
        const remesh::Topology topology = remesh::analyze_topology({positions, dual});
        EXPECT_TRUE(topology.is_manifold);
        EXPECT_TRUE(topology.is_oriented);
        EXPECT_EQ(dual.size() + remesh::rim_of(dual).size(), wanted.faces);
        EXPECT_EQ(topology.components.size(), wanted.components);
        EXPECT_EQ(topology.genus(), wanted.genus);
        EXPECT_EQ(topology.boundary_loops(), wanted.loops);
    }
}

// With B edges on the boundary, V - E + F = 2 - 2 genus - loops, and 2 E = 3 F + B.
TEST(BuildDual, HasTheTopologyOfManySites) {
    expect_topology(shapes::sphere(3), 100, {196, 0, 0, 1});
    expect_topology(shapes::sphere(4), 1000, {1996, 0, 0, 1});
    expect_topology(shapes::torus(40, 20), 300, {600, 1, 0, 1});
    expect_topology(shapes::join(shapes::sphere(3), shapes::torus(40, 20)), 500, {996, 1, 0, 2});
    expect_topology(shapes::tube(60, 30), 500, {1000, 0, 2, 1});
    expect_topology(shapes::grid(40), 500, {998, 0, 1, 1});
}

}  // namespace
