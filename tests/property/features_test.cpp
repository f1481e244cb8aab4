// The whole job on parts by formula: straight edges, true corners and flat faces.
#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "agvd/mesh/surface.h"
#include "remesh/pipeline/remesh.h"
#include "support/crease_checks.h"
#include "support/dice.h"
#include "support/files.h"
#include "support/parts.h"
#include "support/shapes.h"

using namespace agvd;
using remesh::Features;
using remesh::RemeshOptions;
using remesh::RemeshResult;

namespace {

struct Part {
    std::string name;
    TriangleMesh mesh;
    Index curves = 0;           // Those of the boundary included.
    std::vector<Vec3> corners;  // All nodes whose place is known.
    Index other_nodes = 0;
    Index fewest = 0;     // Vertices that the network needs.
    double tolerance = 0; // Of the chains.
    bool is_flat = false;
};

std::vector<Vec3> signs(double x, double y, double z) {
    std::vector<Vec3> result;
    for (const double sx : {-1., 1.}) {
        for (const double sy : {-1., 1.}) result.emplace_back(sx * x, sy * y, z);
    }
    return result;
}

std::vector<Vec3> corners_of_box() {
    std::vector<Vec3> result;
    for (int i = 0; i < 8; ++i) result.emplace_back(i & 1, i >> 1 & 1, i >> 2);
    return result;
}

std::vector<Vec3> extruded(const std::vector<Vec3>& outline) {
    std::vector<Vec3> result = outline;
    for (const Vec3& p : outline) result.push_back(p + Vec3(0, 0, 1));
    return result;
}

Part box() { return {"box", parts::box({1, 1, 1}, 6), 12, corners_of_box(), 0, 8, 1e-6, true}; }

Part open_box() {
    return {"open box", parts::open_box({1, 1, 1}, 6), 12, corners_of_box(), 0, 8, 1e-6, true};
}

Part prism() {
    std::vector<Vec3> outline;
    for (int i = 0; i < 6; ++i) {
        const double angle = i * std::numbers::pi / 3;
        outline.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
    return {"prism", parts::hexagonal_prism(4), 18, extruded(outline), 0, 12, 1e-6, true};
}

Part extruded_l() {
    return {"L",
            parts::extruded_l(5),
            18,
            extruded({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}),
            0,
            12,
            1e-6,
            true};
}

Part cylinder() {
    return {"cylinder", parts::capped_cylinder(64, 6), 2, {}, 0, 6, 3e-3, false};
}

Part cone() { return {"cone", parts::cone_on_plate(48, 6), 2, {}, 0, 6, 6e-3, false}; }

Part vaults() {
    std::vector<Vec3> corners = signs(2, 1, 0);
    for (const auto& more : {signs(5, 1, 0), signs(2, 3, 0)}) {
        corners.insert(corners.end(), more.begin(), more.end());
    }
    return {"vaults", parts::crossing_vaults(20), 14, corners, 0, 12, .01, false};
}

// A crease that ends in nothing, and a slit that gapes, or else cleaning would close it.
Part slit_plate() {
    Part part{"slit plate", parts::folded_plate(32, 80, true), 8, signs(4, 1, 0), 1, 10, 1e-6,
              false};
    const auto num_whole = parts::folded_plate(32, 80, false).positions.size();
    for (auto v = num_whole; v < part.mesh.positions.size(); ++v) part.mesh.positions[v].x() += .02;
    part.corners[0].z() = part.corners[1].z() = std::tan(40 * std::numbers::pi / 180);
    for (const Vec3& p : {Vec3(3.5, -.5, 0), Vec3(3.5, .5, 0), Vec3(-4, 0, 0)}) {
        part.corners.push_back(p);
    }
    return part;
}

std::vector<Part> all_parts() {
    return {box(), open_box(), prism(), extruded_l(), cylinder(), cone(), vaults(), slit_plate()};
}

RemeshResult run(const TriangleMesh& mesh, const RemeshOptions& options) {
    return remesh::remesh(mesh.view(), options);
}

void expect_sound(const RemeshResult& result, Index num_samples) {
    EXPECT_EQ(result.mesh.positions.size(), num_samples);
    EXPECT_EQ(result.sites.size(), num_samples);
    const remesh::Topology topology = remesh::analyze_topology(result.mesh.view());
    EXPECT_TRUE(topology.is_manifold);
    EXPECT_TRUE(topology.is_oriented);
    EXPECT_TRUE(same_topology(topology, result.input_topology));
    EXPECT_EQ(result.self_intersections.value_or(0), 0u);
}

void expect_network(const Part& part, const RemeshResult& result) {
    EXPECT_EQ(result.features.curves, part.curves);
    EXPECT_EQ(result.features.nodes, part.corners.size() + part.other_nodes);
    EXPECT_FALSE(result.features.gave_up);
    EXPECT_EQ(result.features.dropped_length, 0);
}

void expect_sharp(const Part& part, const RemeshResult& result, bool is_coarse) {
    EXPECT_LT(crease_checks::farthest_from_vertices(part.corners, result.mesh), 1e-9);
    // Few chords are too far from curves that are not straight.
    if (part.tolerance < 1e-3 || !is_coarse) {
        EXPECT_EQ(crease_checks::coverage(part.mesh, result.mesh, part.tolerance), 1);
    }
    if (part.is_flat) {
        EXPECT_LT(crease_checks::farthest_from_surface(result.mesh, part.mesh), 1e-9);
    }
}

}  // namespace

TEST(Features, PartsKeepTheirNetworkAtEveryNumberOfVertices) {
    for (const Part& part : all_parts()) {
        for (const Index n : {50u, 200u, 2000u}) {
            SCOPED_TRACE(part.name + ", " + std::to_string(n));
            const RemeshResult result = run(part.mesh, {.num_samples = n});
            expect_sound(result, n);
            expect_network(part, result);
            expect_sharp(part, result, n < 1000);
        }
    }
}

// By angle alone: where chains are shorter than the spacing, all of them may be noise.
TEST(Features, TheFewestVerticesThatTheNetworkNeedsAreEnough) {
    for (const Part& part : all_parts()) {
        for (const Index n : {part.fewest, part.fewest + 1, part.fewest + 7}) {
            SCOPED_TRACE(part.name + ", " + std::to_string(n));
            const RemeshResult result =
                run(part.mesh, {.num_samples = n, .features = Features::Angle});
            expect_sound(result, n);
            expect_network(part, result);
            expect_sharp(part, result, true);
            EXPECT_EQ(result.features.samples_for_all, part.fewest);
        }
    }
}
