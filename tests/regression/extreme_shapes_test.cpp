// Shapes that once made remesh() crash or hang: scales, needles, spikes, strips and caps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "agvd/core/error.h"
#include "agvd/mesh/scale.h"
#include "remesh/pipeline/remesh.h"
#include "support/dirty_shapes.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

void expect_remeshed(const TriangleMesh& mesh, Index num_samples) {
    const remesh::RemeshResult result = remesh::remesh(mesh.view(), {.num_samples = num_samples});
    EXPECT_EQ(result.mesh.positions.size(), num_samples);
    const remesh::Topology topology = remesh::analyze_topology(result.mesh.view());
    EXPECT_TRUE(topology.is_manifold);
    EXPECT_TRUE(topology.is_oriented);
    EXPECT_TRUE(same_topology(topology, result.input_topology));
}

// A cap as CAD writes it: all faces around one apex.
TriangleMesh cone(Index sides) {
    TriangleMesh mesh;
    mesh.positions.emplace_back(0, 0, 1);
    for (Index i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
        mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % sides});
    }
    return mesh;
}

TEST(ExtremeShapes, ATetrahedronOfTinySize) {
    for (const double size : {1e-50, 1e50, 1e75}) {
        SCOPED_TRACE(size);
        TriangleMesh mesh = shapes::tetrahedron();
        for (Vec3& p : mesh.positions) p *= size;
        expect_remeshed(mesh, 4);
        expect_remeshed(mesh, 10);
    }
}

TEST(ExtremeShapes, AGridPressedFlat) {
    for (const double height : {1e-3, 1e-6, 1e-9}) {
        SCOPED_TRACE(height);
        TriangleMesh mesh = shapes::grid(40);
        for (Vec3& p : mesh.positions) p.y() *= height;
        expect_remeshed(mesh, 200);
    }
}

TEST(ExtremeShapes, ASphereWithALongSpike) {
    TriangleMesh mesh = shapes::sphere(3);
    mesh.positions[0] = {1e4, 0, 0};
    expect_remeshed(mesh, 200);
}

TEST(ExtremeShapes, ATubeOfThreeSidesAndSixFaces) { expect_remeshed(shapes::tube(3, 1), 100); }

TEST(ExtremeShapes, AConeOfThousandsOfFacesAroundOneApex) { expect_remeshed(cone(5000), 300); }

// Its corners but for three lie on the sides of a triangle: all faces are needles.
TEST(ExtremeShapes, APlateThatIsOnePolygonWithCornersOnItsSides) {
    TriangleMesh mesh;
    constexpr Index count = 333;
    const std::array<Vec3, 3> corners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    for (std::size_t side = 0; side < 3; ++side) {
        for (Index i = 0; i < count; ++i) {
            const double share = static_cast<double>(i) / count;
            mesh.positions.push_back((1 - share) * corners[side] + share * corners[(side + 1) % 3]);
        }
    }
    // A fan around the corner (0, 0, 0): those along its own two sides have no area.
    for (Index i = 1; i + 1 < 3 * count; ++i) mesh.triangles.push_back({0, i, i + 1});
    expect_remeshed(mesh, 100);
}

TEST(ExtremeShapes, AnyScaleGivesTheScaledMesh) {
    const TriangleMesh mesh = shapes::jitter(shapes::cube(), 0.1, 5);
    const remesh::RemeshResult usual = remesh::remesh(mesh.view(), {.num_samples = 100});
    ASSERT_GT(usual.features.length, 0);
    for (const int exponent : {-900, -160, -100, 100, 160, 900}) {
        SCOPED_TRACE(exponent);
        const TriangleMesh other = scaled(mesh.view(), exponent);
        const remesh::RemeshResult result = remesh::remesh(other.view(), {.num_samples = 100});
        EXPECT_EQ(result.mesh.positions, scaled(usual.mesh.view(), exponent).positions);
        EXPECT_EQ(result.mesh.triangles, usual.mesh.triangles);
        EXPECT_EQ(result.features.length, std::ldexp(usual.features.length, exponent));
        EXPECT_EQ(result.input_topology.components.at(0).area,
                  std::ldexp(usual.input_topology.components.at(0).area, 2 * exponent));
        ASSERT_EQ(result.relaxation.size(), usual.relaxation.size());
        EXPECT_EQ(result.relaxation[0].energy[0],
                  std::ldexp(usual.relaxation[0].energy[0], 4 * exponent));
    }
}

TEST(ExtremeShapes, LongSpikesEndInAMeshOrAReason) {
    Index num_done = 0, num_refused = 0;
    for (const auto& [seed, most] : {std::pair{0u, 9u},
                                     {1u, 9u},
                                     {2u, 9u},
                                     {5u, 9u},
                                     {7u, 9u},
                                     {8u, 9u},
                                     {0u, 17u},
                                     {1u, 17u},
                                     {2u, 17u},
                                     {8u, 17u}}) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", up to 1e" + std::to_string(most));
        const TriangleMesh mesh = shapes::spiked(seed, most);
        try {
            const remesh::RemeshResult result = remesh::remesh(mesh.view(), {.num_samples = 20});
            const remesh::Topology topology = remesh::analyze_topology(result.mesh.view());
            EXPECT_TRUE(same_topology(topology, result.input_topology));
            EXPECT_EQ(result.mesh.positions.size(), 20u);
            ++num_done;
        } catch (const agvd::ConstraintUnmet&) {
        } catch (const agvd::InvalidInput&) {
            EXPECT_EQ(most, 17u);
            ++num_refused;
        }
    }
    EXPECT_GE(num_done, 3u);
    EXPECT_GE(num_refused, 2u);
}

// Rounding tilts edges against a spike 10^12 times as long as wide, and flips there do not come to
// an end: without a base that is Delaunay all stages would take a minute.
TEST(ExtremeShapes, APartTooThinForDoubleIsRefused) {
    const TriangleMesh ball = shapes::moved(shapes::sphere(3), Vec3(3, 0, 0));
    const Vec3 tip(-0.55, 0.53, -0.62);
    for (const Index v : {5u, 7u, 11u}) {
        TriangleMesh thin = shapes::sphere(1);
        for (Vec3& p : thin.positions) p *= 1e-12;
        thin.positions[v] = tip;
        const TriangleMesh mesh = shapes::join(ball, thin);
        try {
            (void)remesh::remesh(mesh.view(), {.num_samples = 100});
            ADD_FAILURE() << "a result for " << v;
        } catch (const InvalidInput& error) {
            const std::string text = error.what();
            EXPECT_NE(text.find(" times as long as high"), std::string::npos) << text;
            ASSERT_EQ(text.rfind("face ", 0), 0u) << text;
            const Triangle& t = mesh.triangles.at(std::stoul(text.substr(5)));
            EXPECT_TRUE(std::any_of(t.begin(), t.end(),
                                    [&](Index corner) { return mesh.positions[corner] == tip; }));
        }
    }
}

// The boundary alone needs more vertices, and there is no crease that could be dropped.
TEST(ExtremeShapes, AFeatureEdgeOnABoundaryThatNeedsMoreVertices) {
    const TriangleMesh mesh = shapes::tube(3, 1);  // Vertices 0, 2 and 4 are one of its ends.
    const remesh::RemeshOptions few{
        .num_samples = 4, .features = remesh::Features::Off, .feature_edges = {{0, 2}}};
    EXPECT_THROW((void)remesh::remesh(mesh.view(), few), ConstraintUnmet);
}

TEST(ExtremeShapes, AThinTriangleIsNotRefinedByItsLength) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1000, 0, 0}, {500, 1e-3, 0}};  // 10 000 spacings.
    mesh.triangles = {{0, 1, 2}};
    constexpr Index samples = 50;
    const remesh::RemeshResult result = remesh::remesh(mesh.view(), {.num_samples = samples});
    EXPECT_GT(result.refined_faces, samples);
    EXPECT_LE(result.refined_faces, 40 * samples);  // At most 16 splits a site, 2 faces each.
    EXPECT_EQ(result.mesh.positions.size(), samples);
}

}  // namespace
