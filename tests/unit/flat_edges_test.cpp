#include "remesh/repair/flat_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "agvd/mesh/refine.h"
#include "agvd/mesh/surface.h"
#include "remesh/quality/topology.h"
#include "remesh/repair/carry_sites.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// A prism over a regular polygon, its caps fans of slivers from one corner each.
TriangleMesh prism(Index n) {
    TriangleMesh mesh;
    for (const double z : {0.0, 1.0}) {
        for (Index i = 0; i < n; ++i) {
            const double angle = 2 * std::numbers::pi * i / n;
            mesh.positions.emplace_back(std::cos(angle), std::sin(angle), z);
        }
    }
    for (Index i = 1; i + 1 < n; ++i) {
        mesh.triangles.push_back({0, i + 1, i});
        mesh.triangles.push_back({n, n + i, n + i + 1});
    }
    for (Index i = 0; i < n; ++i) {
        const Index j = (i + 1) % n;
        mesh.triangles.push_back({i, j, n + i});
        mesh.triangles.push_back({j, n + j, n + i});
    }
    return mesh;
}

double total_length(const TriangleMesh& mesh) {
    double sum = 0;
    for (const double length : build_surface(mesh.view()).length) sum += length;
    return sum;
}

}  // namespace

TEST(FlatEdges, FansOfSliversGoAndTheSurfaceStays) {
    const TriangleMesh before = prism(100);
    TriangleMesh after = before;
    EXPECT_GT(remesh::flip_flat_edges(after, 0.5), 100u);
    EXPECT_EQ(after.positions, before.positions);
    EXPECT_NEAR(shapes::signed_volume(after), shapes::signed_volume(before), 1e-9);
    EXPECT_TRUE(same_topology(remesh::analyze_topology(before.view()),
                              remesh::analyze_topology(after.view())));
    EXPECT_LT(total_length(after), 0.9 * total_length(before));
    EXPECT_LT(3 * split_long_edges(after.view(), 0.2).mesh.triangles.size(),
              2 * split_long_edges(before.view(), 0.2).mesh.triangles.size());
}

TEST(FlatEdges, ShortEdgesAndBentOnesStay) {
    TriangleMesh mesh = prism(100);
    EXPECT_EQ(remesh::flip_flat_edges(mesh, 3), 0u);  // None is long.
    EXPECT_EQ(mesh.triangles, prism(100).triangles);
    TriangleMesh bent = shapes::jitter(shapes::sphere(3), 0.01, 7);
    const auto triangles = bent.triangles;
    EXPECT_EQ(remesh::flip_flat_edges(bent, 0.01), 0u);
    EXPECT_EQ(bent.triangles, triangles);
}

TEST(FlatEdges, SitesKeepTheirPlaces) {
    const TriangleMesh mesh = prism(30);
    remesh::CleanResult clean = remesh::clean_input(mesh.view());
    ASSERT_GT(remesh::flip_flat_edges(clean.mesh, 0.1), 0u);
    std::vector<SurfacePoint> sites;
    for (Index f = 0; f < mesh.triangles.size(); ++f) sites.push_back({FaceId(f), {.2, .3, .5}});
    const auto carried = remesh::to_cleaned(sites, mesh.view(), clean);
    const auto back = remesh::to_original(carried, mesh.view(), clean);
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const Vec3 place = position(mesh.view(), sites[i]);
        EXPECT_LT((position(clean.mesh.view(), carried[i]) - place).norm(), 1e-8);
        EXPECT_LT((position(mesh.view(), back[i]) - place).norm(), 1e-8);
    }
}
