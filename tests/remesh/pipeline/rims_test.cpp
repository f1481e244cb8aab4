// Triangles along boundaries are as good as others: at rims with teeth, around small holes, and
// next to corners, which stay.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "agvd/core/random.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"
#include "support/parts.h"
#include "support/shapes.h"

using namespace agvd;
using remesh::RemeshOptions;
using remesh::RemeshResult;

namespace {

// Drops vertices without a face.
TriangleMesh compact(const TriangleMesh& mesh) {
    TriangleMesh result;
    std::vector<Index> number(mesh.positions.size(), no_index);
    for (Triangle t : mesh.triangles) {
        for (Index& v : t) {
            if (number[v] == no_index) {
                number[v] = static_cast<Index>(result.positions.size());
                result.positions.push_back(mesh.positions[v]);
            }
            v = number[v];
        }
        result.triangles.push_back(t);
    }
    return result;
}

// A sphere of uneven triangles without the faces whose centroid lies beyond a plane: a rim with
// teeth of one triangle each.
TriangleMesh sphere_with_teeth(int levels, const Vec3& normal) {
    TriangleMesh mesh = shapes::jitter(shapes::sphere(levels), 0.01, 7);
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        const Vec3 sum = mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]];
        return sum.dot(normal) > 3 * 0.4 * normal.norm();
    });
    return compact(mesh);
}

// A sphere without the faces around `count` vertices that lie apart.
TriangleMesh sphere_with_holes(int levels, std::size_t count) {
    TriangleMesh mesh = shapes::sphere(levels);
    std::vector<Vec3> centres;
    std::set<Index> is_centre;
    for (std::uint64_t i = 0; centres.size() < count; ++i) {
        const auto v = static_cast<Index>(random_bits(3, 0, i) % mesh.positions.size());
        const Vec3& p = mesh.positions[v];
        const bool is_apart = std::all_of(centres.begin(), centres.end(),
                                          [&](const Vec3& c) { return (c - p).norm() > 0.3; });
        if (!is_apart) continue;
        centres.push_back(p);
        is_centre.insert(v);
    }
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        return std::any_of(t.begin(), t.end(), [&](Index v) { return is_centre.contains(v); });
    });
    return compact(mesh);
}

// A flat sector with a tip of 20 degrees at the origin, radius 1.
TriangleMesh wedge(Index rows) {
    const double angle = std::numbers::pi / 9;
    TriangleMesh mesh;
    for (Index row = 0; row <= rows; ++row) {
        for (Index i = 0; i <= row; ++i) {
            const double u = row == 0 ? 0 : angle * i / row;
            mesh.positions.push_back(Vec3(std::cos(u), std::sin(u), 0) * row / rows);
        }
    }
    for (Index row = 0; row < rows; ++row) {
        const Index here = row * (row + 1) / 2, next = here + row + 1;
        for (Index i = 0; i <= row; ++i) {
            mesh.triangles.push_back({here + i, next + i, next + i + 1});
            if (i < row) mesh.triangles.push_back({here + i, next + i + 1, here + i + 1});
        }
    }
    return mesh;
}

struct RimShape {
    double smallest_angle = 0;  // Degrees.
    double least_quality = 0;
};

RimShape shape_of(const TriangleMesh& mesh) {
    const auto measures = remesh::measure_triangles(mesh.view());
    return {measures.min_angle * 180 / std::numbers::pi, measures.min_quality};
}

void expect_valid(const TriangleMesh& mesh, const RemeshOptions& options,
                  const RemeshResult& result) {
    const remesh::Topology topology = remesh::analyze_topology(result.mesh.view());
    EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
    EXPECT_TRUE(same_topology(topology, remesh::analyze_topology(mesh.view())));
    EXPECT_EQ(result.mesh.positions.size(), options.num_samples);
    EXPECT_EQ(result.sites.size(), options.num_samples);
    EXPECT_EQ(result.self_intersections.value_or(0), 0u);
}

}  // namespace

TEST(Rims, TeethOfAScanMakeNoThinTriangles) {
    int num_cases = 0;
    for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(1, 0.3, 0.2)}) {
        const TriangleMesh mesh = sphere_with_teeth(4, normal);
        for (const Index n : {300u, 800u, 1500u}) {
            const RemeshOptions options{.num_samples = n};
            const RemeshResult result = remesh::remesh(mesh.view(), options);
            SCOPED_TRACE(std::to_string(n) + " vertices, x of the normal " +
                         std::to_string(normal.x()));
            expect_valid(mesh, options, result);
            const RimShape shape = shape_of(result.mesh);
            EXPECT_GT(shape.smallest_angle, 28);
            EXPECT_GT(shape.least_quality, 0.45);
            ++num_cases;
        }
    }
    EXPECT_EQ(num_cases, 6);
}

TEST(Rims, HolesSmallerThanTheSpacingHaveNoThinTrianglesAroundThem) {
    const TriangleMesh mesh = sphere_with_holes(5, 40);
    for (const Index n : {800u, 1500u}) {
        const RemeshOptions options{.num_samples = n};
        const RemeshResult result = remesh::remesh(mesh.view(), options);
        SCOPED_TRACE(std::to_string(n) + " vertices");
        expect_valid(mesh, options, result);
        const RimShape shape = shape_of(result.mesh);
        EXPECT_GT(shape.smallest_angle, 25);
        EXPECT_GT(shape.least_quality, 0.45);
    }
}

// The loops need more sites than the coarse level has.
TEST(Rims, SamplesThatAreEnoughForManyHolesAreNotRefused) {
    const TriangleMesh mesh = sphere_with_holes(4, 40);
    const RemeshOptions options{.num_samples = 400};
    expect_valid(mesh, options, remesh::remesh(mesh.view(), options));
}

TEST(Rims, ASharpCornerThatLastsStaysAndItsNeighboursAreGood) {
    const TriangleMesh mesh = wedge(40);
    for (const Index n : {60u, 200u, 600u}) {
        SCOPED_TRACE(std::to_string(n) + " vertices");
        const RemeshOptions options{.num_samples = n};
        const RemeshResult result = remesh::remesh(mesh.view(), options);
        expect_valid(mesh, options, result);
        const std::vector<Vec3>& p = result.mesh.positions;
        EXPECT_NE(std::find(p.begin(), p.end(), Vec3(0, 0, 0)), p.end());
        Index num_thin = 0;
        for (const Triangle& t : result.mesh.triangles) {
            const TriangleMesh alone{{p[t[0]], p[t[1]], p[t[2]]}, {{0, 1, 2}}};
            if (shape_of(alone).smallest_angle < 28) ++num_thin;
        }
        EXPECT_LE(num_thin, 2u);
    }
}

// With a quarter of the vertices half of them would lie at holes.
// Mending takes vertices away and adds others.
TEST(Rims, VerticesOfGivenSitesStayNearTheirSites) {
    const TriangleMesh mesh = sphere_with_teeth(4, Vec3(1, 0.3, 0.2));
    const RemeshResult plain = remesh::remesh(mesh.view(), {.num_samples = 800, .relax_steps = 0});
    const RemeshResult relaxed =
        remesh::remesh(mesh.view(), {.sites = plain.sites, .relax_steps = 3});
    ASSERT_EQ(relaxed.sites.size(), plain.sites.size());
    double farthest = 0;
    for (std::size_t i = 0; i < plain.sites.size(); ++i) {
        farthest = std::max(farthest, (position(mesh.view(), relaxed.sites[i]) -
                                       position(mesh.view(), plain.sites[i]))
                                          .norm());
    }
    EXPECT_LT(farthest, 0.3);
    EXPECT_GT(farthest, 0);
}

// The two are a quarter of the mean edge apart.
TEST(Rims, OfAThinPlateBothStayAndTrianglesBetweenThemAreGood) {
    const RemeshResult result =
        remesh::remesh(parts::box({4, 3, 0.05}, 6).view(), {.num_samples = 600});
    EXPECT_EQ(result.self_intersections.value_or(0), 0u);
    EXPECT_LT(result.verdict.largest_distance, 0.1 * 0.05);
    EXPECT_GT(result.verdict.min_angle, 0.3);
}
