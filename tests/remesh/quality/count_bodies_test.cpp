// Holes, and closed components that are bodies, cavities or inside out.
#include <gtest/gtest.h>

#include "agvd/mesh/topology.h"
#include "remesh/quality/evaluate.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;

namespace {

remesh::BodyCounts count(const TriangleMesh& mesh) {
    return remesh::count_bodies(mesh.view(), remesh::analyze_topology(mesh.view()));
}

TriangleMesh turned(TriangleMesh mesh) {
    for (agvd::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

TriangleMesh cube_at(double low, double side) {
    TriangleMesh mesh = shapes::cube();
    for (Vec3& p : mesh.positions) p = side * p + Vec3::Constant(low);
    return mesh;
}

}  // namespace

TEST(CountBodies, HolesAndTheirEdges) {
    const remesh::BodyCounts sheet = count(shapes::grid(3));
    EXPECT_EQ(sheet.holes, 1u);
    EXPECT_EQ(sheet.hole_edges, 12u);
    EXPECT_EQ(sheet.closed, 0u);
    const remesh::BodyCounts tube = count(shapes::join(shapes::tube(6, 2), cube_at(5, 1)));
    EXPECT_EQ(tube.holes, 2u);
    EXPECT_EQ(tube.hole_edges, 12u);
    EXPECT_EQ(tube.closed, 1u);
}

// One in another in another, with rays through vertices and edges, and one beside them.
TEST(CountBodies, ClosedComponentsInOthers) {
    const TriangleMesh outer = cube_at(0, 8), middle = cube_at(1, 6), inner = cube_at(2, 4);
    const auto with = [&](const TriangleMesh& a, const TriangleMesh& b, const TriangleMesh& c) {
        return count(shapes::join(shapes::join(a, b), shapes::join(c, cube_at(10, 1))));
    };
    const remesh::BodyCounts hollow = with(outer, turned(middle), inner);
    EXPECT_EQ(hollow.closed, 4u);
    EXPECT_EQ(hollow.cavities, 1u);
    EXPECT_EQ(hollow.inner_bodies, 1u);
    EXPECT_EQ(hollow.inside_out, 0u);
    const remesh::BodyCounts bad = with(turned(outer), middle, turned(inner));
    EXPECT_EQ(bad.inside_out, 1u);
    EXPECT_EQ(bad.cavities, 1u);
    EXPECT_EQ(bad.inner_bodies, 1u);
    EXPECT_EQ(bad.holes, 0u);
}

TEST(CountBodies, VolumesHaveASign) {
    const TriangleMesh mesh =
        shapes::join(shapes::join(cube_at(100, 2), turned(cube_at(-50, 3))), shapes::grid(2));
    const std::vector<double> volumes =
        remesh::body_volumes(mesh.view(), remesh::analyze_topology(mesh.view()));
    ASSERT_EQ(volumes.size(), 3u);
    EXPECT_NEAR(volumes[0], 8, 1e-12);
    EXPECT_NEAR(volumes[1], -27, 1e-12);
    EXPECT_EQ(volumes[2], 0);
}
