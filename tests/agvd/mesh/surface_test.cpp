#include "agvd/mesh/surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "agvd/core/error.h"
#include "support/shapes.h"

using namespace agvd;

TEST(Surface, TwinsRunOppositeWays) {
    const Surface s = build_surface(shapes::sphere(2).view());
    for (Index h = 0; h < s.twin.size(); ++h) {
        ASSERT_NE(s.twin[h], no_index);
        EXPECT_EQ(s.twin[s.twin[h]], h);
        EXPECT_EQ(s.tail(h), s.head(s.twin[h]));
        EXPECT_EQ(s.edge[h], s.edge[s.twin[h]]);
    }
    EXPECT_EQ(s.num_vertices() + s.num_faces(), s.num_edges() + 2);
}

TEST(Surface, FramesReproduceEdgeLengths) {
    const Surface s = build_surface(shapes::jitter(shapes::sphere(2), 0.02, 7).view());
    for (Index h = 0; h < s.twin.size(); ++h) {
        EXPECT_GT(s.apex[h].y(), 0);
        EXPECT_NEAR(s.apex[h].norm(), s.length_of(Surface::previous(h)), 1e-14);
        EXPECT_NEAR((s.apex[h] - Vec2(s.length_of(h), 0)).norm(), s.length_of(Surface::next(h)),
                    1e-14);
    }
}

TEST(Surface, BoundaryLoopsAreClosedCycles) {
    const Surface s = build_surface(shapes::tube(12, 5).view());
    const auto loops = boundary_loops(s);
    ASSERT_EQ(loops.size(), 2u);
    for (const auto& loop : loops) {
        EXPECT_EQ(loop.size(), 12u);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            EXPECT_EQ(s.twin[loop[i]], no_index);
            EXPECT_EQ(s.head(loop[i]), s.tail(loop[(i + 1) % loop.size()]));
        }
    }
}

TEST(Surface, DefectsAreNamedByElement) {
    const auto text_of = [](TriangleMesh mesh) -> std::string {
        try {
            (void)build_surface(mesh.view());
        } catch (const InvalidInput& error) {
            return error.what();
        }
        return "";
    };
    TriangleMesh mesh = shapes::tetrahedron();
    mesh.triangles[2] = {0, 2, 9};
    EXPECT_NE(text_of(mesh).find("face 2 names vertex 9"), std::string::npos);
    mesh = shapes::tetrahedron();
    std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
    EXPECT_NE(text_of(mesh).find("oriented differently"), std::string::npos);
    mesh = shapes::tetrahedron();
    mesh.positions[1].x() = std::nan("");
    EXPECT_NE(text_of(mesh).find("vertex 1"), std::string::npos);
    mesh = shapes::join(shapes::tetrahedron(), shapes::tetrahedron());
    for (Triangle& t : mesh.triangles) {
        for (Index& v : t) v = v == 4 ? 0 : v;
    }
    EXPECT_NE(text_of(mesh).find("around vertex 0"), std::string::npos);
}
