#include "remesh/clean/coarsen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "agvd/mesh/topology.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Vec3;
using remesh::CoarseMesh;

namespace {

constexpr double unlimited = 1e9;

CoarseMesh coarsened(const agvd::TriangleMesh& mesh, const remesh::CoarsenOptions& options) {
    return remesh::coarsen(agvd::build_surface(mesh.view()), {}, {}, options);
}

// Of the edges of a surface between points for which is_on(position) holds at both ends.
template <typename IsOn>
std::vector<std::uint8_t> edges_on(const agvd::Surface& surface, const IsOn& is_on) {
    std::vector<std::uint8_t> mark;
    for (const Index h : surface.edge_half) {
        mark.push_back(is_on(surface.mesh.positions[surface.tail(h)]) &&
                               is_on(surface.mesh.positions[surface.head(h)])
                           ? 1
                           : 0);
    }
    return mark;
}

TEST(Coarsen, APlaneKeepsItsOutlineAndAsManyFacesAsAsked) {
    const CoarseMesh coarse = coarsened(
        shapes::grid(40), {.num_faces = 200, .longest_edge = unlimited, .most_distance = 1e-9});
    EXPECT_LE(coarse.mesh.triangles.size(), 200u);
    EXPECT_GE(coarse.mesh.triangles.size(), 198u);
    const agvd::Surface surface = agvd::build_surface(coarse.mesh.view());
    EXPECT_NEAR(agvd::surface_area(surface), 1, 1e-12);
    EXPECT_EQ(agvd::boundary_loops(surface).size(), 1u);
}

TEST(Coarsen, EdgesStayBelowTheLongest) {
    const CoarseMesh coarse =
        coarsened(shapes::grid(40), {.num_faces = 0, .longest_edge = 0.2, .most_distance = 1});
    const agvd::Surface surface = agvd::build_surface(coarse.mesh.view());
    EXPECT_LE(shapes::longest_edge(surface), 0.2);
    EXPECT_LT(surface.num_faces(), 300u);
}

TEST(Coarsen, VerticesAreThoseOfTheInput) {
    const agvd::TriangleMesh sphere = shapes::sphere(5);
    const CoarseMesh coarse =
        coarsened(sphere, {.num_faces = 1000, .longest_edge = unlimited, .most_distance = 1});
    ASSERT_EQ(coarse.vertex_origin.size(), coarse.mesh.positions.size());
    EXPECT_TRUE(std::ranges::is_sorted(coarse.vertex_origin));
    for (Index v = 0; v < coarse.vertex_origin.size(); ++v) {
        EXPECT_EQ(coarse.mesh.positions[v], sphere.positions[coarse.vertex_origin[v]]);
    }
    // A sphere of 1000 even triangles fills .986 of the ball.
    EXPECT_GT(shapes::signed_volume(coarse.mesh) / shapes::signed_volume(sphere), 0.97);
}

TEST(Coarsen, NoVertexGoesFartherThanAsked) {
    const CoarseMesh coarse = coarsened(
        shapes::sphere(5), {.num_faces = 0, .longest_edge = unlimited, .most_distance = 1e-2});
    EXPECT_GT(coarse.mesh.triangles.size(), 300u);
    EXPECT_LT(coarse.mesh.triangles.size(), 6000u);
    for (const agvd::Triangle& t : coarse.mesh.triangles) {
        const Vec3 middle = (coarse.mesh.positions[t[0]] + coarse.mesh.positions[t[1]] +
                             coarse.mesh.positions[t[2]]) /
                            3;
        EXPECT_GT(middle.norm(), 1 - 4e-2);
    }
}

TEST(Coarsen, AClosedSurfaceEndsAsFewFacesAndNotAsNone) {
    const remesh::CoarsenOptions all{
        .num_faces = 0, .longest_edge = unlimited, .most_distance = unlimited};
    EXPECT_EQ(coarsened(shapes::tetrahedron(), all).mesh.triangles.size(), 4u);
    const CoarseMesh two = coarsened(
        shapes::join(shapes::sphere(2), shapes::moved(shapes::sphere(2), {5, 0, 0})), all);
    const auto topology = agvd::analyze_topology(two.mesh.view());
    EXPECT_EQ(topology.components.size(), 2u);
    EXPECT_GE(two.mesh.triangles.size(), 8u);
}

TEST(Coarsen, TopologyStaysOnRandomSurfaces) {
    int count = 0;
    for (const agvd::TriangleMesh& mesh :
         {shapes::torus(40, 20), shapes::tube(30, 30), shapes::lips(20, 20, 3),
          shapes::jitter(shapes::torus(30, 15), 0.02, 1), shapes::jitter(shapes::grid(30), 0.01, 2),
          shapes::join(shapes::torus(20, 10), shapes::moved(shapes::cube(), {4, 0, 0}))}) {
        const auto before = agvd::analyze_topology(mesh.view());
        for (const Index faces : {Index{0}, static_cast<Index>(mesh.triangles.size() / 4)}) {
            const CoarseMesh coarse =
                coarsened(mesh, {.num_faces = faces,
                                 .longest_edge = unlimited,
                                 .most_distance = faces == 0 ? unlimited : 0.1});
            const auto after = agvd::analyze_topology(coarse.mesh.view());
            EXPECT_TRUE(after.is_manifold);
            EXPECT_TRUE(after.is_oriented);
            EXPECT_TRUE(agvd::same_topology(after, before));
            EXPECT_LT(coarse.mesh.triangles.size(), mesh.triangles.size());
            ++count;
        }
    }
    EXPECT_EQ(count, 12);
}

// A line through the middle of a plane costs no distance, and yet stays where it is.
TEST(Coarsen, CurvesStay) {
    const agvd::Surface surface = agvd::build_surface(shapes::grid(32).view());
    const auto on_line = [](const Vec3& p) { return std::abs(p.x() - 0.5) < 1e-12; };
    const std::vector<std::uint8_t> mark = edges_on(surface, on_line);
    ASSERT_EQ(std::ranges::count(mark, 1), 32);
    const CoarseMesh coarse = remesh::coarsen(
        surface, mark, {}, {.num_faces = 100, .longest_edge = 0.3, .most_distance = 1});
    const agvd::Surface after = agvd::build_surface(coarse.mesh.view());
    double length = 0;
    int count = 0;
    for (Index h = 0; h < coarse.mark.size(); ++h) {
        if (coarse.mark[h] == 0) continue;
        EXPECT_TRUE(on_line(after.mesh.positions[after.tail(h)]));
        EXPECT_TRUE(on_line(after.mesh.positions[after.head(h)]));
        ASSERT_NE(after.twin[h], agvd::no_index);
        EXPECT_EQ(coarse.mark[after.twin[h]], coarse.mark[h]);
        length += after.length_of(h) / 2;
        ++count;
    }
    EXPECT_NEAR(length, 1, 1e-12);
    EXPECT_LT(count, 40);  // Of 64 sides.
}

TEST(Coarsen, VerticesThatStayAndEndsOfCurvesStay) {
    const agvd::Surface surface = agvd::build_surface(shapes::grid(20).view());
    std::vector<std::uint8_t> stays(surface.num_vertices(), 0);
    stays[77] = stays[300] = 1;
    // A curve along x = .5 that ends inside.
    const std::vector<std::uint8_t> mark = edges_on(surface, [](const Vec3& p) {
        return std::abs(p.x() - 0.5) < 1e-12 && p.y() < 0.5 + 1e-12;
    });
    const CoarseMesh coarse = remesh::coarsen(
        surface, mark, stays, {.num_faces = 0, .longest_edge = unlimited, .most_distance = 1});
    for (const Index v : {77u, 300u})
        EXPECT_TRUE(std::ranges::binary_search(coarse.vertex_origin, v));
    const auto is_end = [](const Vec3& p) { return (p - Vec3(0.5, 0.5, p.z())).norm() < 1e-12; };
    EXPECT_EQ(std::ranges::count_if(coarse.mesh.positions, is_end), 1);
    EXPECT_LT(coarse.mesh.triangles.size(), 100u);
}

TEST(Coarsen, TheNumberOfThreadsChangesNothing) {
    const agvd::Surface surface = agvd::build_surface(shapes::torus(80, 40).view());
    remesh::CoarsenOptions options{.num_faces = 900, .longest_edge = 1, .most_distance = 1};
    options.num_threads = 1;
    const CoarseMesh one = remesh::coarsen(surface, {}, {}, options);
    options.num_threads = 4;
    const CoarseMesh four = remesh::coarsen(surface, {}, {}, options);
    EXPECT_EQ(one.mesh.triangles, four.mesh.triangles);
    EXPECT_EQ(one.vertex_origin, four.vertex_origin);
}

}  // namespace
