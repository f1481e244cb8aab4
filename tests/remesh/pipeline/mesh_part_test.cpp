#include "remesh/pipeline/mesh_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface_points.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Vec3;

namespace {

TEST(MeshPart, RingsCountEdges) {
    constexpr Index n = 8;
    const agvd::TriangleMesh grid = shapes::grid(n);
    const std::vector<Index> start{0};
    const std::vector<Index> ring =
        remesh::detail::rings_around(grid.triangles, grid.positions.size(), start, 5);
    int num_far = 0;
    for (Index v = 0; v < ring.size(); ++v) {
        // Along the diagonals of the grid one edge goes as far as two others.
        const auto x = static_cast<Index>(std::lround(grid.positions[v].x() * n)),
                   y = static_cast<Index>(std::lround(grid.positions[v].y() * n));
        const Index along = std::max(x, y), around = x + y;
        if (ring[v] == agvd::no_index) {
            EXPECT_GT(around, 5u);
            ++num_far;
        } else {
            EXPECT_TRUE(ring[v] == along || ring[v] == around) << x << ' ' << y;
        }
    }
    EXPECT_GT(num_far, 20);
    EXPECT_LT(num_far, 70);
}

TEST(MeshPart, RingsDoNotPassTrianglesThatAreLeftOut) {
    const agvd::TriangleMesh grid = shapes::grid(6);
    std::vector<std::uint8_t> is_left_out;
    for (const agvd::Triangle& t : grid.triangles) {
        const Vec3 middle =
            (grid.positions[t[0]] + grid.positions[t[1]] + grid.positions[t[2]]) / 3;
        is_left_out.push_back(middle.x() > 0.5 && middle.x() < 0.5 + 1.0 / 6 ? 1 : 0);
    }
    const std::vector<Index> start{0};
    const std::vector<Index> ring = remesh::detail::rings_around(
        grid.triangles, grid.positions.size(), start, 100, is_left_out);
    for (Index v = 0; v < ring.size(); ++v) {
        EXPECT_EQ(ring[v] != agvd::no_index, grid.positions[v].x() < 0.51) << v;
    }
}

// Faces of the size of the radius, and needles that hold no corner within it.
TEST(MeshPart, FacesAroundAPointAreThoseWithinTheRadius) {
    agvd::TriangleMesh needles = shapes::grid(16);
    for (Vec3& p : needles.positions) p.x() *= 1000;
    int num_needles = 0;
    for (const agvd::TriangleMesh& mesh : {shapes::sphere(4), needles}) {
        const agvd::Surface surface = agvd::build_surface(mesh.view());
        const agvd::SurfacePoint start{agvd::FaceId(surface.num_faces() / 2), {0.3, 0.3, 0.4}};
        const Vec3 at = position(mesh.view(), start);
        const std::vector<Index> faces = remesh::detail::faces_around(surface, {&start, 1}, 0.4);
        EXPECT_TRUE(std::ranges::is_sorted(faces));
        for (Index f = 0; f < surface.num_faces(); ++f) {
            const auto corners = corners_of(mesh.view(), f);
            const double distance_sq =
                agvd::closest_point_on_triangle(corners, agvd::FaceId(f), at).distance_sq;
            EXPECT_EQ(std::ranges::binary_search(faces, f), distance_sq <= 0.16) << f;
            const bool is_needle = std::ranges::all_of(
                corners, [&](const Vec3& corner) { return (corner - at).norm() > 0.4; });
            num_needles += distance_sq <= 0.16 && is_needle ? 1 : 0;
        }
        EXPECT_GT(faces.size(), 10u);
        EXPECT_LT(faces.size(), surface.num_faces() / 4);
    }
    EXPECT_GT(num_needles, 10);
}

}  // namespace
