#include "remesh/pipeline/mesh_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

TEST(MeshPart, FacesAroundAPointAreThoseWithinTheRadius) {
    const agvd::Surface surface = agvd::build_surface(shapes::sphere(4).view());
    const agvd::SurfacePoint start = point_at(surface, 17);
    const Vec3 at = position(surface.mesh.view(), start);
    const std::vector<Index> faces = remesh::detail::faces_around(surface, {&start, 1}, 0.4);
    EXPECT_TRUE(std::ranges::is_sorted(faces));
    std::size_t count = 0;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        const bool is_near = std::ranges::any_of(surface.mesh.triangles[f], [&](Index v) {
            return (surface.mesh.positions[v] - at).norm() <= 0.4;
        });
        EXPECT_EQ(std::ranges::binary_search(faces, f), is_near) << f;
        count += is_near ? 1 : 0;
    }
    EXPECT_GT(count, 200u);
    EXPECT_LT(count, 400u);
}

}  // namespace
