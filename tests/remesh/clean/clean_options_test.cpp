// Repairs that are made only if asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "agvd/core/error.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/topology.h"
#include "remesh/clean/carry.h"
#include "remesh/clean/clean_input.h"
#include "remesh/quality/evaluate.h"
#include "support/dice.h"
#include "support/dirty_shapes.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::CleanResult;

namespace {

CleanResult cleaned(const TriangleMesh& mesh, const remesh::CleanOptions& options) {
    CleanResult clean = remesh::clean_input(mesh.view(), options);
    EXPECT_NO_THROW((void)agvd::build_surface(clean.mesh.view()));
    return clean;
}

int num_holes(const TriangleMesh& mesh) {
    return remesh::analyze_topology(mesh.view()).boundary_loops();
}

// Without the faces at a vertex: a hole of as many edges as these.
TriangleMesh without_vertex(TriangleMesh mesh, Index vertex) {
    std::erase_if(mesh.triangles, [&](const agvd::Triangle& t) {
        return t[0] == vertex || t[1] == vertex || t[2] == vertex;
    });
    return mesh;
}

// Without CGAL it says so, and nothing can be filled.
bool can_fill() {
    const TriangleMesh tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                   {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}}};
    try {
        (void)remesh::clean_input(tetrahedron.view(), {.fill_holes = 3});
        return true;
    } catch (const agvd::InvalidOption& error) {
        EXPECT_NE(std::string(error.what()).find("CGAL"), std::string::npos);
        return false;
    }
}

}  // namespace

TEST(CleanOptions, GapsOfASoupCloseWithinTheTolerance) {
    const TriangleMesh model = shapes::sphere(2);  // Edges of .3.
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const TriangleMesh soup = shapes::jitter(shapes::unweld(model), 0.01, seed);
        EXPECT_EQ(cleaned(soup, {.weld = 0.0001}).mesh.positions.size(), soup.positions.size());
        const CleanResult clean = cleaned(soup, {.weld = 0.05});
        EXPECT_TRUE(remesh::same_topology(remesh::analyze_topology(clean.mesh.view()),
                                          remesh::analyze_topology(model.view())));
        EXPECT_EQ(clean.counts,
                  remesh::CleanCounts{.welded_vertices = static_cast<Index>(
                                          soup.positions.size() - model.positions.size())});
        ASSERT_EQ(clean.welded_positions.size(), soup.positions.size());
        for (Index v = 0; v < soup.positions.size(); ++v) {
            EXPECT_LT((clean.welded_positions[v] - soup.positions[v]).norm(), 0.05);
        }
    }
}

TEST(CleanOptions, ATolerancePastTheEdgesClosesNoHole) {
    // Holes of three edges, far smaller than the tolerance.
    TriangleMesh mesh = shapes::sphere(2);
    mesh.triangles.pop_back();
    mesh.triangles.erase(mesh.triangles.begin());
    const CleanResult clean = cleaned(mesh, {.weld = 10});
    EXPECT_EQ(clean.mesh.triangles, mesh.triangles);
    EXPECT_EQ(clean.counts, remesh::CleanCounts{});
}

TEST(CleanOptions, WeldIsALength) {
    for (const double weld : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THROW((void)remesh::clean_input(shapes::cube().view(), {.weld = weld}),
                     agvd::InvalidOption);
    }
}

TEST(CleanOptions, AMissingFaceComesBack) {
    if (!can_fill()) GTEST_SKIP() << "without CGAL";
    const TriangleMesh model = shapes::sphere(1);
    TriangleMesh mesh = model;
    mesh.triangles.pop_back();
    agvd::Triangle filled = cleaned(mesh, {.fill_holes = 3}).mesh.triangles.back();
    std::ranges::rotate(filled, std::ranges::find(filled, model.triangles.back()[0]));
    EXPECT_EQ(filled, model.triangles.back());
}

TEST(CleanOptions, HolesOfFewEdgesAreFilled) {
    if (!can_fill()) GTEST_SKIP() << "without CGAL";
    Dice dice(7);
    for (int i = 0; i < 20; ++i) {
        TriangleMesh mesh = shapes::sphere(2);
        Vec3 axis(dice.number(-1, 1), dice.number(-1, 1), dice.number(-1, 1));
        axis.normalize();
        Index near = 0, far = 0;
        for (Index v = 0; v < mesh.positions.size(); ++v) {
            if (mesh.positions[v].dot(axis) > mesh.positions[near].dot(axis)) near = v;
            if (mesh.positions[v].dot(axis) < mesh.positions[far].dot(axis)) far = v;
        }
        mesh = without_vertex(without_vertex(mesh, near), far);
        const auto six = static_cast<Index>(mesh.triangles.size());
        EXPECT_EQ(cleaned(mesh, {.fill_holes = 4}).counts.filled_holes, 0u);
        const CleanResult clean = cleaned(mesh, {.fill_holes = 6});
        EXPECT_EQ(clean.counts.filled_holes, 2u);
        EXPECT_EQ(num_holes(clean.mesh), 0);
        EXPECT_TRUE(remesh::analyze_topology(clean.mesh.view()).is_oriented);
        EXPECT_TRUE(remesh::find_self_intersections(clean.mesh.view())->empty());
        EXPECT_GT(shapes::signed_volume(clean.mesh), 0);
        // What was there is there still, and the new faces have origins beside them.
        for (Index f = 0; f < six; ++f) EXPECT_EQ(clean.face_origin[f], f);
        for (Index f = six; f < clean.mesh.triangles.size(); ++f) {
            const agvd::Triangle& t = mesh.triangles[clean.face_origin[f]];
            const auto is_shared = [&](Index v) { return v == t[0] || v == t[1] || v == t[2]; };
            EXPECT_GE(
                std::ranges::count_if(clean.mesh.triangles[f],
                                      [&](Index v) { return is_shared(clean.vertex_origin[v]); }),
                1);
        }
    }
}

TEST(CleanOptions, AHoleStaysWhereFillingWouldNotBeManifold) {
    if (!can_fill()) GTEST_SKIP() << "without CGAL";
    const TriangleMesh alone{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    EXPECT_EQ(cleaned(alone, {.fill_holes = 3}).mesh.triangles, alone.triangles);
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const TriangleMesh soup = shapes::random_soup(9, 12, seed);
        try {
            const CleanResult clean = cleaned(soup, {.fill_holes = 12});
            const remesh::Topology topology = remesh::analyze_topology(clean.mesh.view());
            EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
        } catch (const agvd::InvalidInput&) {  // Not orientable, or no face is left.
        }
    }
}
