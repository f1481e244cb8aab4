#include "remesh/transfer/transfer.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "agvd/core/error.h"
#include "agvd/core/random.h"
#include "agvd/mesh/closest_point.h"
#include "remesh/pipeline/remesh.h"
#include "support/dirty_shapes.h"
#include "support/shapes.h"

using agvd::FaceId;
using agvd::Index;
using agvd::SurfacePoint;
using agvd::TriangleMesh;
using agvd::Vec3;

namespace {

SurfacePoint inner_point(Index face, std::uint64_t i) {
    const double u = 0.1 + 0.4 * agvd::random_unit(5, i, 0);
    const double v = 0.1 + 0.4 * agvd::random_unit(5, i, 1);
    return {FaceId(face), {1 - u - v, u, v}};
}

std::vector<SurfacePoint> inner_points(Index num_faces) {
    std::vector<SurfacePoint> points;
    for (Index f = 0; f < num_faces; ++f) points.push_back(inner_point(f, f));
    return points;
}

// A result without faces whose vertices are the points, each moved.
template <typename Move>
TriangleMesh moved_points(const TriangleMesh& mesh, const std::vector<SurfacePoint>& points,
                          const Move& move) {
    TriangleMesh result;
    for (std::size_t i = 0; i < points.size(); ++i) {
        result.positions.push_back(position(mesh.view(), points[i]) + move(i));
    }
    return result;
}

Vec3 random_shift(std::uint64_t i, double size) {
    return size * Vec3(agvd::random_unit(7, i, 0) - 0.5, agvd::random_unit(7, i, 1) - 0.5,
                       agvd::random_unit(7, i, 2) - 0.5);
}

}  // namespace

TEST(MapToInput, VerticesAtTheirSitesStayBitForBit) {
    const TriangleMesh sphere = shapes::sphere(3);
    std::vector<SurfacePoint> sites = inner_points(static_cast<Index>(sphere.triangles.size()));
    sites.push_back({FaceId(4), {0, 1, 0}});
    sites.push_back({FaceId(9), {0.25, 0, 0.75}});
    const TriangleMesh result = moved_points(
        sphere, sites, [](std::size_t i) { return Vec3(i % 2 == 0 ? 2e-16 : 0, 0, 0); });
    EXPECT_EQ(remesh::map_to_input(sphere.view(), result.view(), sites).vertices, sites);
}

TEST(MapToInput, MovedVerticesGetTheNearestPoint) {
    for (const TriangleMesh& mesh : {shapes::sphere(4), shapes::unweld(shapes::sphere(4))}) {
        const auto sites = inner_points(static_cast<Index>(mesh.triangles.size()));
        const TriangleMesh result =
            moved_points(mesh, sites, [](std::size_t i) { return random_shift(i, 0.4); });
        const agvd::ClosestPointTree tree(mesh.view());
        const auto map = remesh::map_to_input(mesh.view(), result.view(), sites);
        Index num_in_other_faces = 0;
        for (Index v = 0; v < sites.size(); ++v) {
            const Vec3& p = result.positions[v];
            const Vec3 found = position(mesh.view(), map.vertices[v]);
            EXPECT_NEAR((found - p).norm(), std::sqrt(tree.query(p).distance_sq), 1e-14);
            if (map.vertices[v].face != sites[v].face) ++num_in_other_faces;
        }
        EXPECT_GT(num_in_other_faces, sites.size() / 4);
    }
}

TEST(MapToInput, TheOtherSideOfAThinWallIsNotNearer) {
    // A closed slab, so that both sides are connected around its rim.
    TriangleMesh slab = shapes::cube();
    for (int i = 0; i < 4; ++i) slab = shapes::subdivide(slab);
    for (Vec3& p : slab.positions) p.z() *= 1e-3;
    double top = 0;
    for (const Vec3& p : slab.positions) top = std::max(top, p.z());
    std::vector<SurfacePoint> sites;
    for (const SurfacePoint& point : inner_points(static_cast<Index>(slab.triangles.size()))) {
        if (position(slab.view(), point).z() > top - 1e-9) sites.push_back(point);
    }
    ASSERT_GT(sites.size(), 400u);
    const TriangleMesh result =
        moved_points(slab, sites, [](std::size_t) { return Vec3(1e-5, -1e-5, -9e-4); });
    const auto map = remesh::map_to_input(slab.view(), result.view(), sites);
    for (Index v = 0; v < sites.size(); ++v) {
        const Vec3 above(result.positions[v].x(), result.positions[v].y(), top);
        EXPECT_NEAR((position(slab.view(), map.vertices[v]) - above).norm(), 0, 1e-14);
    }
}

TEST(MapToInput, FacesAreSampledWhereTheyLie) {
    // Each face of the result holds 16 faces of the input: those of two subdivisions.
    const TriangleMesh coarse = shapes::grid(3);
    const TriangleMesh fine = shapes::subdivide(shapes::subdivide(coarse));
    const agvd::ClosestPointTree tree(fine.view());
    std::vector<SurfacePoint> sites;
    for (const Vec3& p : coarse.positions) sites.push_back(tree.query(p).point);
    const auto map = remesh::map_to_input(fine.view(), coarse.view(), sites, {.with_faces = true});
    ASSERT_EQ(map.faces.size(), coarse.triangles.size());
    std::vector<int> hits(fine.triangles.size(), 0);
    for (const remesh::FaceSamples& faces : map.faces) {
        for (const Index f : faces) ++hits[f];
    }
    EXPECT_EQ(hits, std::vector<int>(fine.triangles.size(), 1));
}

TEST(MapToInput, ThreadsDoNotChangeIt) {
    const TriangleMesh torus = shapes::torus(60, 30);
    const remesh::RemeshResult made = remesh::remesh(torus.view(), {.num_samples = 600});
    const auto with = [&](int num_threads) {
        return remesh::map_to_input(torus.view(), made.mesh.view(), made.sites,
                                    {.with_faces = true, .num_threads = num_threads});
    };
    const auto one = with(1);
    for (const int num_threads : {2, 8}) {
        const auto more = with(num_threads);
        EXPECT_EQ(more.vertices, one.vertices);
        EXPECT_EQ(more.faces, one.faces);
    }
}

TEST(MapToInput, FittedVerticesGetTheNearestPointOfTheirSheet) {
    const TriangleMesh torus = shapes::torus(60, 30);
    const remesh::RemeshResult made = remesh::remesh(torus.view(), {.num_samples = 300});
    const auto map = remesh::map_to_input(torus.view(), made.mesh.view(), made.sites);
    const agvd::ClosestPointTree tree(torus.view());
    Index num_moved = 0;
    for (Index v = 0; v < made.sites.size(); ++v) {
        const Vec3& p = made.mesh.positions[v];
        const double distance = (position(torus.view(), map.vertices[v]) - p).norm();
        EXPECT_NEAR(distance, std::sqrt(tree.query(p).distance_sq), 1e-14);
        if (distance > 1e-6) ++num_moved;
    }
    EXPECT_GT(num_moved, 200u);
}

TEST(MapToInput, ItCanBeStoppedAndChecksItsInput) {
    const TriangleMesh sphere = shapes::sphere(6);
    const auto sites = inner_points(static_cast<Index>(sphere.triangles.size()));
    const TriangleMesh result =
        moved_points(sphere, sites, [](std::size_t i) { return random_shift(i, 0.01); });
    EXPECT_THROW(
        static_cast<void>(remesh::map_to_input(sphere.view(), result.view(), sites,
                                               {.progress = [](double) { return false; }})),
        agvd::Cancelled);
    EXPECT_THROW(static_cast<void>(remesh::map_to_input(sphere.view(), sphere.view(), sites)),
                 agvd::InvalidOption);
    EXPECT_THROW(static_cast<void>(remesh::map_to_input(sphere.view(), result.view(), sites,
                                                        {.num_threads = -1})),
                 agvd::InvalidOption);
}
