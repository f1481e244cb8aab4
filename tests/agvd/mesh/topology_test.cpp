#include "agvd/mesh/topology.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

using agvd::analyze_topology;

TEST(Topology, ClosedSurfaces) {
    const auto sphere = analyze_topology(shapes::sphere(1).view());
    EXPECT_TRUE(sphere.is_manifold && sphere.is_oriented);
    ASSERT_EQ(sphere.components.size(), 1u);
    EXPECT_EQ(sphere.genus(), 0);
    const auto torus = analyze_topology(shapes::torus(9, 7).view());
    EXPECT_EQ(torus.genus(), 1);
    EXPECT_EQ(torus.boundary_loops(), 0);
    EXPECT_FALSE(same_topology(sphere, torus));
}

TEST(Topology, OpenSurfacesAndComponents) {
    const auto both = analyze_topology(shapes::join(shapes::tube(8, 3), shapes::grid(4)).view());
    ASSERT_EQ(both.components.size(), 2u);
    EXPECT_EQ(both.components[0].boundary_loops, 2);
    EXPECT_EQ(both.components[1].boundary_loops, 1);
    EXPECT_EQ(both.genus(), 0);
    EXPECT_NEAR(both.components[1].area, 1, 1e-14);
}

TEST(Topology, SurfacesDifferByTheirBoundaryLoopsAndComponentsToo) {
    const auto tube = analyze_topology(shapes::tube(8, 3).view());
    const auto sheet = analyze_topology(shapes::grid(4).view());
    const auto sphere = analyze_topology(shapes::sphere(1).view());
    EXPECT_FALSE(same_topology(tube, sheet));
    EXPECT_FALSE(same_topology(sheet, sphere));
    EXPECT_TRUE(same_topology(sheet, analyze_topology(shapes::grid(7).view())));
    const auto two = analyze_topology(shapes::join(shapes::grid(4), shapes::grid(4)).view());
    EXPECT_FALSE(same_topology(sheet, two));
    const auto one_way = analyze_topology(shapes::join(shapes::grid(4), shapes::tube(8, 3)).view());
    const auto other_way =
        analyze_topology(shapes::join(shapes::tube(8, 3), shapes::grid(4)).view());
    EXPECT_TRUE(same_topology(one_way, other_way));
}

TEST(Topology, DefectsAreSeen) {
    agvd::TriangleMesh mesh = shapes::tetrahedron();
    mesh.triangles.push_back(mesh.triangles[0]);
    EXPECT_FALSE(analyze_topology(mesh.view()).is_manifold);
    mesh = shapes::tetrahedron();
    std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
    EXPECT_TRUE(analyze_topology(mesh.view()).is_manifold);
    EXPECT_FALSE(analyze_topology(mesh.view()).is_oriented);
    mesh = shapes::join(shapes::tetrahedron(), shapes::tetrahedron());
    for (auto& t : mesh.triangles) {
        for (auto& v : t) v = v == 4 ? 0 : v;
    }
    EXPECT_FALSE(analyze_topology(mesh.view()).is_manifold) << "two umbrellas at vertex 0";
}

TEST(Topology, IsTheSameWhereConnectivityIsKnown) {
    const agvd::TriangleMesh mixed =
        shapes::join(shapes::join(shapes::tube(8, 3), shapes::torus(9, 7)),
                     shapes::join(shapes::grid(4), shapes::cube()));
    for (const agvd::TriangleMesh& mesh : {shapes::sphere(2), shapes::torus(9, 7), mixed}) {
        const auto expected = analyze_topology(mesh.view());
        const auto found = analyze_topology(mesh.view(), *agvd::find_connectivity(mesh.view()));
        EXPECT_TRUE(found.is_manifold && found.is_oriented);
        EXPECT_EQ(found.face_component, expected.face_component);
        ASSERT_EQ(found.components.size(), expected.components.size());
        for (std::size_t i = 0; i < found.components.size(); ++i) {
            EXPECT_EQ(found.components[i].faces, expected.components[i].faces);
            EXPECT_EQ(found.components[i].euler, expected.components[i].euler);
            EXPECT_EQ(found.components[i].boundary_loops, expected.components[i].boundary_loops);
            EXPECT_EQ(found.components[i].genus, expected.components[i].genus);
            EXPECT_EQ(found.components[i].area, expected.components[i].area);
        }
    }
}
