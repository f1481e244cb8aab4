// A surface simplified to points is a simplicial manifold of its topology, whatever the points.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include <algorithm>
#include <set>

#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/intrinsic/simplify.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"
#include "support/points.h"
#include "support/random_surfaces.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

TriangleMesh drawn(const Surface& surface, std::span<const SurfacePoint> points,
                   const SimplifiedMesh& simplified) {
    TriangleMesh mesh{{}, simplified.triangles};
    for (const SurfacePoint& p : points) {
        mesh.positions.push_back(position(surface.mesh.view(), p));
    }
    for (const SurfacePoint& p : simplified.extra) {
        mesh.positions.push_back(position(surface.mesh.view(), p));
    }
    return mesh;
}

void expect_simplified(const Surface& surface, std::span<const SurfacePoint> points) {
    for (const agvd::Component& component : agvd::find_components(surface)) {
        std::vector<SurfacePoint> mine;
        for (const Index i : distinct_points(surface, points)) {
            if (std::binary_search(component.faces.begin(), component.faces.end(),
                                   points[i].face.value())) {
                mine.push_back(points[i]);
            }
        }
        const SimplifiedMesh simplified = simplify(surface, component.faces, mine);
        const TriangleMesh mesh = drawn(surface, mine, simplified);
        const remesh::Topology topology = remesh::analyze_topology(mesh.view());
        EXPECT_TRUE(topology.is_manifold);
        EXPECT_TRUE(topology.is_oriented);
        ASSERT_EQ(topology.components.size(), 1u);
        EXPECT_EQ(topology.components[0].genus, component.genus());
        EXPECT_EQ(topology.components[0].boundary_loops, component.boundary_loops);
        std::set<Index> used;
        for (const Triangle& t : mesh.triangles) used.insert(t.begin(), t.end());
        EXPECT_EQ(used.size(), mesh.positions.size());
        // What an irreducible triangulation may have (joret2010), and as much for each loop.
        const int most = std::max(4, 26 * component.genus() - 4) + 8 * component.boundary_loops;
        EXPECT_LE(simplified.extra.size(), static_cast<std::size_t>(most));
    }
}

class Thin : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(RandomSurfaces, Thin,
                         testing::ValuesIn(random_surfaces::families().begin(),
                                           random_surfaces::families().end()),
                         [](const auto& family) { return std::string(family.param); });

}  // namespace

TEST_P(Thin, KeepsTheTopologyOnTheInputAndOnTheIntrinsicTriangulation) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        SCOPED_TRACE(seed);
        const Surface surface = build_surface(random_surfaces::make(GetParam(), seed).view());
        Dice dice(seed);
        const auto count = static_cast<Index>(dice.magnitude(1, 1000));
        const std::vector<SurfacePoint> points = points::scattered(surface, count, seed);
        expect_simplified(surface, points);
        const IntrinsicTriangulation base(surface);
        expect_simplified(base.surface(), base.to_intrinsic(points));
    }
}

TEST(Simplify, AFlatSquareGetsThePlanesDelaunayTriangulation) {
    const Surface surface = build_surface(shapes::grid(12).view());
    std::vector<SurfacePoint> points;
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        const Vec3& p = surface.mesh.positions[v];
        if ((p.x() != 0 && p.x() != 1) || (p.y() != 0 && p.y() != 1)) continue;
        SurfacePoint corner{FaceId(Surface::face(surface.outgoing[v])), {0, 0, 0}};
        corner.barycentric[surface.outgoing[v] % 3] = 1;
        points.push_back(corner);
    }
    ASSERT_EQ(points.size(), 4u);
    Dice dice(5);
    for (int i = 0; i < 40; ++i) {
        const double a = dice.number(0.1, 0.5), b = dice.number(0.1, 0.4);
        points.push_back({FaceId(dice.count(0, surface.num_faces() - 1)), {a, b, 1 - a - b}});
    }
    std::vector<Index> faces(surface.num_faces());
    for (Index f = 0; f < faces.size(); ++f) faces[f] = f;
    const SimplifiedMesh simplified = simplify(surface, faces, points);
    EXPECT_TRUE(simplified.extra.empty());
    const TriangleMesh mesh = drawn(surface, points, simplified);
    double area = 0;
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vec3 &a = mesh.positions[i], &b = mesh.positions[j], &c = mesh.positions[k];
        const double doubled = (b - a).cross(c - a).z();
        EXPECT_GT(doubled, 0);
        area += doubled / 2;
    }
    EXPECT_NEAR(area, 1, 1e-12);
    EXPECT_EQ(remesh::measure_triangles(mesh.view()).non_delaunay_edges, 0u);
}

// Vertices of the sides go whose faces no flip has changed yet, while those beside them have been.
TEST(Simplify, AFlatStripWithDividedSidesIsNotFolded) {
    const TriangleMesh strip{{{0, 0, 0}, {100, 0, 0}, {98, 3, 0}, {2, 3, 0}},
                             {{0, 1, 2}, {0, 2, 3}}};
    const Surface surface = build_surface(strip.view());
    for (const Index n : {5u, 20u, 100u}) {
        SCOPED_TRACE(n);
        const double spacing = std::sqrt(294.0 / n);
        const IntrinsicTriangulation base(surface,
                                          {.max_length = 0.85 * spacing, .most_splits = 100'000});
        std::vector<SurfacePoint> points{point_on(0, 0), point_on(1, 0), point_on(2, 0),
                                         point_on(5, 0)};
        const std::vector<SurfacePoint> inner = uniform_points(surface, n, 7);
        points.insert(points.end(), inner.begin(), inner.end());
        std::vector<Index> faces(base.surface().num_faces());
        std::iota(faces.begin(), faces.end(), Index{0});
        const SimplifiedMesh simplified =
            simplify(base.surface(), faces, base.to_intrinsic(points));
        EXPECT_TRUE(simplified.extra.empty());
        const TriangleMesh mesh = drawn(surface, points, simplified);
        double area = 0;
        for (const Triangle& t : mesh.triangles) {
            const Vec3 normal = doubled_normal(mesh.positions, t);
            EXPECT_GT(normal.z(), 0);
            area += normal.z() / 2;
        }
        EXPECT_NEAR(area, 294, 1e-9);
    }
}

TEST(Simplify, PointsOnVerticesAreTheMeshItselfWhereTheseAreAll) {
    const Surface surface = build_surface(shapes::icosahedron().view());
    std::vector<SurfacePoint> points(surface.num_vertices());
    for (Index h = 0; h < surface.twin.size(); ++h) {
        SurfacePoint corner{FaceId(h / 3), {0, 0, 0}};
        corner.barycentric[h % 3] = 1;
        points[surface.tail(h)] = corner;
    }
    std::vector<Index> faces(surface.num_faces());
    for (Index f = 0; f < faces.size(); ++f) faces[f] = f;
    const SimplifiedMesh simplified = simplify(surface, faces, points);
    EXPECT_EQ(simplified.triangles, surface.mesh.triangles);
}

TEST(Simplify, IsTheSameTwice) {
    const Surface surface = build_surface(shapes::torus(40, 20).view());
    std::vector<Index> faces(surface.num_faces());
    for (Index f = 0; f < faces.size(); ++f) faces[f] = f;
    const std::vector<SurfacePoint> points = points::scattered(surface, 100, 3);
    EXPECT_EQ(simplify(surface, faces, points).triangles,
              simplify(surface, faces, points).triangles);
}

// Lips a tenth of a spacing wide.
TEST(Simplify, ServesWhereCellsFailAndTheResultSaysSo) {
    const TriangleMesh mesh = shapes::torus(120, 12, 0.02);
    const remesh::RemeshResult few =
        remesh::remesh(mesh.view(), {.num_samples = 60, .num_threads = 1});
    EXPECT_GE(few.dual.simplified_parts, 1u);
    EXPECT_EQ(few.mesh.positions.size(), 60u);
    EXPECT_TRUE(same_topology(remesh::analyze_topology(few.mesh.view()), few.input_topology));
    const remesh::RemeshResult ample =
        remesh::remesh(shapes::torus(60, 30).view(), {.num_samples = 1000, .num_threads = 1});
    EXPECT_EQ(ample.dual.simplified_parts, 0u);
}

double smallest_angle(const TriangleMesh& mesh) {
    return remesh::measure_triangles(mesh.view()).min_angle * 180 / std::numbers::pi;
}

// Strips a quarter of a spacing wide.
TEST(Simplify, LipsNarrowerThanTheSpacingGetNoThinTriangles) {
    const TriangleMesh mesh = shapes::lips(300, 96, 12);
    remesh::RemeshOptions options{.num_samples = 2000, .num_threads = 1};
    const remesh::RemeshResult result = remesh::remesh(mesh.view(), options);
    EXPECT_GE(result.dual.simplified_parts, 1u);
    EXPECT_EQ(result.mesh.positions.size(), 2000u);
    EXPECT_EQ(result.sites.size(), 2000u);
    EXPECT_TRUE(same_topology(remesh::analyze_topology(result.mesh.view()), result.input_topology));
    EXPECT_GT(smallest_angle(result.mesh), 21);
    EXPECT_EQ(result.self_intersections.value_or(0), 0u);
    options.num_threads = 3;
    const remesh::RemeshResult threads = remesh::remesh(mesh.view(), options);
    EXPECT_EQ(threads.mesh.positions, result.mesh.positions);
    EXPECT_EQ(threads.mesh.triangles, result.mesh.triangles);
}
