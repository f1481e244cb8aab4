#include "agvd/mesh/surface_points.h"

#include <gtest/gtest.h>

#include "agvd/diagram/diagram.h"
#include "agvd/propagation/propagate.h"
#include "support/shapes.h"

using agvd::FaceId;
using agvd::Index;
using agvd::SurfacePoint;

TEST(DistinctPoints, KeepsTheFirstOfThoseOnOneSpot) {
    const agvd::Surface surface = agvd::build_surface(shapes::grid(2).view());
    Index inner = 0;  // A half-edge with a face on both sides.
    while (surface.twin[inner] == agvd::no_index) ++inner;
    const auto on_edge = [&](Index h, double ahead) {
        SurfacePoint point{FaceId(agvd::Surface::face(h)), {0, 0, 0}};
        point.barycentric[h % 3] = 1 - ahead;
        point.barycentric[agvd::Surface::next(h) % 3] = ahead;
        return point;
    };
    const Index twin = surface.twin[inner];
    const std::vector<SurfacePoint> sites{
        {FaceId(3), {0.5, 0.25, 0.25}}, on_edge(inner, 0.25), on_edge(inner, 0),
        {FaceId(3), {0.25, 0.5, 0.25}}, on_edge(twin, 0.75),  on_edge(twin, 1),
        {FaceId(2), {0.5, 0.25, 0.25}}, on_edge(twin, 0.25),  {FaceId(3), {0.5, 0.25, 0.25}}};
    EXPECT_EQ(agvd::distinct_points(surface, sites), (std::vector<Index>{0, 1, 2, 3, 6, 7}));
    const auto chosen = agvd::take(sites, std::vector<Index>{7, 0});
    ASSERT_EQ(chosen.size(), 2u);
    EXPECT_EQ(chosen[0].barycentric, sites[7].barycentric);
    EXPECT_EQ(chosen[1].face, sites[0].face);
}

TEST(DistinctPoints, PartsAtOnePositionStayApart) {
    const agvd::TriangleMesh sheet = shapes::grid(1);
    const agvd::Surface surface = agvd::build_surface(shapes::join(sheet, sheet).view());
    const std::vector<SurfacePoint> sites{{FaceId(0), {1, 0, 0}}, {FaceId(2), {1, 0, 0}}};
    EXPECT_EQ(agvd::distinct_points(surface, sites).size(), 2u);
    EXPECT_TRUE(agvd::distinct_points(surface, {}).empty());
}

TEST(DistinctPoints, RepeatedSitesCostNothingAndOwnNothing) {
    const agvd::Surface surface = agvd::build_surface(shapes::torus(20, 10).view());
    const std::vector<SurfacePoint> distinct{{FaceId(90), {0.5, 0.25, 0.25}},
                                             {FaceId(7), {1, 0, 0}}};
    std::vector<SurfacePoint> sites(20, distinct[0]);
    sites.resize(40, distinct[1]);
    const auto name = [](agvd::SiteId site) { return agvd::SiteId(20 * site.value()); };
    for (const auto engine : {agvd::Engine::Window, agvd::Engine::Steiner}) {
        SCOPED_TRACE(agvd::engine_name(engine));
        const agvd::Propagation without = propagate(surface, distinct, {.engine = engine});
        const agvd::Propagation with = propagate(surface, sites, {.engine = engine});
        EXPECT_EQ(with.num_nodes, without.num_nodes);
        EXPECT_EQ(with.vertex_distance, without.vertex_distance);
        EXPECT_EQ(with.mixed_faces, without.mixed_faces);
        for (Index v = 0; v < surface.num_vertices(); ++v) {
            ASSERT_EQ(with.vertex_site[v], name(without.vertex_site[v])) << v;
        }
        ASSERT_EQ(with.relays.size(), without.relays.size());
        for (std::size_t i = 0; i < with.relays.size(); ++i) {
            ASSERT_EQ(with.relays[i].site, name(without.relays[i].site)) << i;
        }
        const agvd::Diagram diagram = build_diagram(surface, sites, with);
        const agvd::Diagram expected = build_diagram(surface, distinct, without);
        ASSERT_EQ(diagram.cell_area.size(), 40u);
        for (Index i = 0; i < 40; ++i) {
            EXPECT_EQ(diagram.cell_area[i], i % 20 == 0 ? expected.cell_area[i / 20] : 0) << i;
        }
        EXPECT_EQ(diagram.points.size(), expected.points.size());
    }
}

// One corner of a square is refined a lot; its quarter still gets a quarter of the points, and the
// points' mean is the square's middle.
TEST(UniformPoints, AreSpreadByAreaNotByFaces) {
    agvd::TriangleMesh mesh = shapes::grid(8);
    for (agvd::Vec3& p : mesh.positions) p = agvd::Vec3(p.x() * p.x(), p.y() * p.y(), 0);
    const agvd::Surface s = agvd::build_surface(mesh.view());
    constexpr agvd::Index count = 40000;
    const auto points = agvd::uniform_points(s, count, 3);
    ASSERT_EQ(points.size(), count);
    agvd::Index in_quarter = 0;
    agvd::Vec3 mean(0, 0, 0);
    for (const auto& point : points) {
        const agvd::Vec3 p = position(s.mesh.view(), point);
        in_quarter += p.x() < 0.5 && p.y() < 0.5;
        mean += p / count;
        for (const double b : point.barycentric) ASSERT_GE(b, 0);
    }
    EXPECT_NEAR(in_quarter / static_cast<double>(count), 0.25, 0.01);
    EXPECT_NEAR(mean.x(), 0.5, 0.01);
    EXPECT_NEAR(mean.y(), 0.5, 0.01);
}

TEST(UniformPoints, FewerPointsAreTheFirstOfMore) {
    const agvd::Surface s = agvd::build_surface(shapes::sphere(1).view());
    const auto few = agvd::uniform_points(s, 5, 9);
    const auto many = agvd::uniform_points(s, 50, 9);
    for (std::size_t i = 0; i < few.size(); ++i) {
        EXPECT_EQ(few[i].face, many[i].face);
        EXPECT_EQ(few[i].barycentric, many[i].barycentric);
    }
    EXPECT_NE(many[0].barycentric, agvd::uniform_points(s, 1, 10)[0].barycentric);
}
