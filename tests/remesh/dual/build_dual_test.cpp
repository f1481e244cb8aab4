#include "remesh/dual/build_dual.h"

#include <gtest/gtest.h>

#include "agvd/mesh/topology.h"
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

}  // namespace
