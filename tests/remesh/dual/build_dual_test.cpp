#include "remesh/dual/build_dual.h"

#include <gtest/gtest.h>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/topology.h"
#include "agvd/propagation/propagate.h"
#include "remesh/curves/glue.h"
#include "remesh/sites/relax_network.h"
#include "support/shapes.h"

using agvd::FaceId;
using agvd::Index;
using agvd::SiteId;

namespace {

// Four cells meet at both ends of the edges between them. The lists of the two Voronoi vertices
// begin anywhere.
agvd::Diagram four_slices(Index first_at_tail, Index first_at_head) {
    agvd::Diagram diagram;
    diagram.num_sites = 4;
    diagram.edge_points = {0};
    for (Index e = 0; e < 4; ++e) {
        diagram.edges.push_back({SiteId(e), SiteId((e + 3) % 4), 0, 1});
        diagram.points.insert(diagram.points.end(),
                              {{FaceId(0), {0.5, 0.25, 0.25}}, {FaceId(0), {0.25, 0.5, 0.25}}});
        diagram.edge_points.push_back(2 * e + 2);
    }
    diagram.vertex_offsets = {0, 4, 8};
    for (Index i = 0; i < 4; ++i) {
        const Index e = (first_at_tail + i) % 4;
        diagram.vertex_ends.push_back({e, true});
        diagram.vertex_sites.emplace_back(e);
    }
    for (Index i = 0; i < 4; ++i) {
        const Index e = (first_at_head + 4 - i) % 4;
        diagram.vertex_ends.push_back({e, false});
        diagram.vertex_sites.emplace_back((e + 3) % 4);
    }
    diagram.vertices = {diagram.points[0], diagram.points[1]};
    diagram.vertex_distance = {1, 1};
    return diagram;
}

// Each Voronoi vertex gives a quad of the same corners. The dual is a tetrahedron.
TEST(BuildDual, QuadsWithTheSameCornersAreCutAlongDifferentDiagonals) {
    const agvd::Surface surface = agvd::build_surface(shapes::grid(1).view());
    const std::vector<agvd::Vec3> positions = shapes::tetrahedron().positions;
    for (Index first_at_tail = 0; first_at_tail < 4; ++first_at_tail) {
        for (Index first_at_head = 0; first_at_head < 4; ++first_at_head) {
            const std::vector<agvd::Triangle> dual =
                remesh::build_dual(surface, four_slices(first_at_tail, first_at_head));
            EXPECT_EQ(dual.size(), 4u);
            const remesh::Topology topology = remesh::analyze_topology({positions, dual});
            EXPECT_TRUE(topology.is_manifold && topology.is_oriented)
                << first_at_tail << ' ' << first_at_head;
            EXPECT_EQ(topology.boundary_loops(), 0);
        }
    }
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
        const std::vector<agvd::Triangle> dual = remesh::build_dual(
            base, agvd::build_diagram(base, on_base, agvd::propagate(base, on_base)));
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
