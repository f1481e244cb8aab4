// The whole job on parts by formula: straight edges, true corners and flat faces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/pipeline/curves.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/placement/placement.h"
#include "remesh/quality/evaluate.h"
#include "remesh/sites/sites.h"
#include "support/crease_checks.h"
#include "support/dice.h"
#include "support/files.h"
#include "support/flag_edges.h"
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
    Index fewest = 0;      // Vertices that the network needs.
    double tolerance = 0;  // Of the chains.
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
    return {"L",  parts::extruded_l(5),
            18,   extruded({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}),
            0,    12,
            1e-6, true};
}

Part cylinder() { return {"cylinder", parts::capped_cylinder(64, 6), 2, {}, 0, 6, 3e-3, false}; }

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
    const TriangleMesh whole =
        parts::folded_plate(32, 8, 1, [](double x) { return 80 * std::clamp(1 - x / 3, 0., 1.); });
    Part part{"slit plate", parts::with_slit(whole, 3.5, 0.5), 8, signs(4, 1, 0), 1, 10, 1e-6,
              false};
    for (auto v = whole.positions.size(); v < part.mesh.positions.size(); ++v)
        part.mesh.positions[v].x() += .02;
    part.corners[0].z() = part.corners[1].z() = std::tan(40 * std::numbers::pi / 180);
    for (const Vec3& p : {Vec3(3.5, -.5, 0), Vec3(3.5, .5, 0), Vec3(-4, 0, 0)}) {
        part.corners.push_back(p);
    }
    return part;
}

std::vector<Part> all_parts() {
    return {box(), open_box(), prism(), extruded_l(), cylinder(), cone(), vaults(), slit_plate()};
}

double shortest_edge(const TriangleMesh& mesh) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto& p = mesh.positions;
        for (const Vec3& edge : {Vec3(p[b] - p[a]), Vec3(p[c] - p[b]), Vec3(p[a] - p[c])}) {
            shortest = std::min(shortest, edge.norm());
        }
    }
    return shortest;
}

double diagonal(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d around;
    for (const Vec3& v : mesh.positions) around.extend(v);
    return around.diagonal().norm();
}

std::vector<Vec3> positions_of(const TriangleMesh& mesh, const RemeshResult& result) {
    std::vector<Vec3> positions;
    for (const SurfacePoint& site : result.sites) {
        positions.push_back(position(mesh.view(), site));
    }
    return positions;
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
            const RemeshResult result = remesh::remesh(part.mesh.view(), {.num_samples = n});
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
                remesh::remesh(part.mesh.view(), {.num_samples = n, .features = Features::Angle});
            expect_sound(result, n);
            expect_network(part, result);
            expect_sharp(part, result, true);
            EXPECT_EQ(result.features.samples_for_all, part.fewest);
        }
    }
}

TEST(Features, ManyVerticesCarryTheNetwork) {
    const Part part = extruded_l();
    const RemeshResult result = remesh::remesh(part.mesh.view(), {.num_samples = 8000});
    expect_sound(result, 8000);
    expect_network(part, result);
    expect_sharp(part, result, false);
}

TEST(Features, TurningScalingAndNoiseKeepTheNetwork) {
    for (const Part& part : all_parts()) {
        for (const double scale : {1e-6, 1., 1e6}) {
            SCOPED_TRACE(part.name + ", " + std::to_string(scale));
            Part other = part;
            // The corners turn with the surface.
            const std::size_t num_vertices = part.mesh.positions.size();
            auto& p = other.mesh.positions;
            p.insert(p.end(), part.corners.begin(), part.corners.end());
            other.mesh = parts::turned(other.mesh, 5);
            for (Vec3& v : p) v *= scale;
            std::copy(p.begin() + static_cast<std::ptrdiff_t>(num_vertices), p.end(),
                      other.corners.begin());
            p.resize(num_vertices);
            const RemeshResult result = remesh::remesh(other.mesh.view(), {.num_samples = 200});
            expect_sound(result, 200);
            expect_network(part, result);
            for (Vec3& v : p) v /= scale;
            for (Vec3& v : other.corners) v /= scale;
            RemeshResult unscaled = result;
            for (Vec3& v : unscaled.mesh.positions) v /= scale;
            expect_sharp(other, unscaled, true);
        }
        SCOPED_TRACE(part.name + ", noise");
        const TriangleMesh noisy = shapes::jitter(part.mesh, 1e-3 * shortest_edge(part.mesh), 3);
        const RemeshResult result = remesh::remesh(noisy.view(), {.num_samples = 200});
        expect_sound(result, 200);
        expect_network(part, result);
        EXPECT_LT(crease_checks::farthest_from_vertices(part.corners, result.mesh), 1e-3);
    }
}

TEST(Features, NeedlesAndSplitsInFlatFacesKeepTheNetwork) {
    for (const Part& part : all_parts()) {
        for (const double aspect : {0.3, 1e-4}) {
            SCOPED_TRACE(part.name + ", " + std::to_string(aspect));
            const TriangleMesh needles = parts::with_needles(part.mesh, aspect, 0.4, 7);
            const RemeshResult result = remesh::remesh(needles.view(), {.num_samples = 200});
            expect_sound(result, 200);
            expect_network(part, result);
            expect_sharp(part, result, true);
        }
    }
}

TEST(Features, ThreadsChangeNothing) {
    for (const Part& part : {extruded_l(), vaults(), slit_plate()}) {
        SCOPED_TRACE(part.name);
        const RemeshResult one =
            remesh::remesh(part.mesh.view(), {.num_samples = 400, .num_threads = 1});
        for (const int threads : {2, 8}) {
            const RemeshResult other =
                remesh::remesh(part.mesh.view(), {.num_samples = 400, .num_threads = threads});
            EXPECT_EQ(one.mesh.positions, other.mesh.positions);
            EXPECT_EQ(one.mesh.triangles, other.mesh.triangles);
        }
    }
}

TEST(Features, WhatVerticesAreTooFewForIsDroppedAndCounted) {
    for (const Part& part : {box(), open_box(), prism(), extruded_l(), vaults()}) {
        const double length =
            remesh::remesh(part.mesh.view(), {.num_samples = 200}).features.length;
        for (Index n = 4; n < part.fewest; ++n) {
            SCOPED_TRACE(part.name + ", " + std::to_string(n));
            const RemeshOptions options{.num_samples = n, .features = Features::Angle};
            const RemeshResult result = remesh::remesh(part.mesh.view(), options);
            expect_sound(result, n);
            EXPECT_LT(result.features.length, length);
            EXPECT_NEAR(result.features.length + result.features.dropped_length, length,
                        1e-9 * length);
            EXPECT_EQ(result.features.samples_for_all, part.fewest);
        }
    }
}

TEST(Features, AnglesDecide) {
    // Walls that meet at 60 and 90 degrees.
    const TriangleMesh prism = parts::hexagonal_prism(4);
    const auto num_curves = [&](Features features, double angle) {
        const RemeshOptions options{
            .num_samples = 300, .features = features, .feature_angle = angle};
        const RemeshResult result = remesh::remesh(prism.view(), options);
        expect_sound(result, 300);
        return result.features.curves;
    };
    EXPECT_EQ(num_curves(Features::Auto, 40), 18u);
    EXPECT_EQ(num_curves(Features::Angle, 40), 18u);
    EXPECT_EQ(num_curves(Features::Angle, 75), 12u);
    EXPECT_EQ(num_curves(Features::Angle, 95), 0u);
    EXPECT_EQ(num_curves(Features::Off, 40), 0u);
    for (const double angle : {0., 180., -40., std::nan("")}) {
        EXPECT_THROW((void)num_curves(Features::Angle, angle), InvalidOption);
    }
}

// Only the boundary leaves the place where it was.
TEST(Features, FreeBoundariesKeepTheCreasesInside) {
    const TriangleMesh plate = cone().mesh;  // Its boundary is a circle of radius 3.
    const auto farthest_outside = [&](const RemeshResult& result) {
        const ClosestPointTree tree(plate.view());
        double farthest = 0;
        for (const Vec3& p : result.mesh.positions) {
            if (std::hypot(p.x(), p.y()) < 2.9) continue;
            farthest = std::max(farthest, std::sqrt(tree.query(p).distance_sq));
        }
        return farthest;
    };
    const RemeshResult keep = remesh::remesh(plate.view(), {.num_samples = 200});
    const RemeshResult free =
        remesh::remesh(plate.view(), {.num_samples = 200, .boundary = remesh::Boundary::Free});
    for (const RemeshResult& result : {keep, free}) {
        expect_sound(result, 200);
        expect_network(cone(), result);
        EXPECT_EQ(crease_checks::coverage(plate, result.mesh, .03), 1);
    }
    EXPECT_LT(farthest_outside(keep), 1e-9);
    EXPECT_GT(farthest_outside(free), 1e-3);
    EXPECT_LT(farthest_outside(free), .05);
}

TEST(Features, GivenSitesCarryTheCreasesThatTheyLieOn) {
    for (const Part& part : {box(), open_box(), extruded_l(), cylinder(), vaults()}) {
        SCOPED_TRACE(part.name);
        const RemeshResult first =
            remesh::remesh(part.mesh.view(), {.num_samples = 400, .fit = false});
        for (const bool keep_sites : {true, false}) {
            const RemeshOptions options{
                .sites = first.sites, .keep_sites = keep_sites, .fit = keep_sites};
            const RemeshResult result = remesh::remesh(part.mesh.view(), options);
            expect_sound(result, 400);
            expect_network(part, result);
            expect_sharp(part, result, true);
            EXPECT_EQ(result.features.uncarried_curves, 0u);
            RemeshOptions one_thread = options;
            one_thread.num_threads = 1;
            EXPECT_EQ(remesh::remesh(part.mesh.view(), one_thread).mesh.positions,
                      result.mesh.positions);
            EXPECT_EQ(result.sites_dropped, 0u);
            if (!keep_sites) continue;
            // In the order given.
            const std::vector<Vec3> positions = positions_of(part.mesh, result);
            for (Index i = 0; i < 400; ++i) {
                EXPECT_LT((positions[i] - first.mesh.positions[i]).norm(), 1e-9);
            }
        }
    }
}

TEST(Features, CreasesWithoutGivenSitesAreDroppedAndCounted) {
    const Part part = box();
    RemeshOptions options{.num_samples = 600, .fit = false};
    const RemeshResult all = remesh::remesh(part.mesh.view(), options);
    // Those inside one edge go.
    options.sites.emplace();
    for (Index i = 0; i < all.sites.size(); ++i) {
        const Vec3& p = all.mesh.positions[i];
        if (p.x() > 0 && p.x() < 1 && p.y() == 0 && p.z() == 0) continue;
        options.sites->push_back(all.sites[i]);
    }
    ASSERT_LT(options.sites->size(), 600u);
    options.keep_sites = true;
    const RemeshResult most = remesh::remesh(part.mesh.view(), options);
    expect_sound(most, static_cast<Index>(options.sites->size()));
    EXPECT_EQ(most.features.uncarried_curves, 1u);
    EXPECT_NEAR(most.features.length, 11, 1e-9);
    EXPECT_NEAR(most.features.dropped_length, 1, 1e-9);
    EXPECT_FALSE(most.features.gave_up);

    // None lies on any.
    options.sites = remesh::sample_sites(build_surface(part.mesh.view()), {.num_samples = 200});
    const RemeshResult none = remesh::remesh(part.mesh.view(), options);
    EXPECT_EQ(none.features.uncarried_curves, 12u);
    EXPECT_EQ(none.features.curves, 0u);
    EXPECT_NEAR(none.features.dropped_length, 12, 1e-9);
    options.features = Features::Off;
    const RemeshResult off = remesh::remesh(part.mesh.view(), options);
    EXPECT_EQ(off.features.dropped_length, 0);
    EXPECT_EQ(none.mesh.positions, off.mesh.positions);
    EXPECT_EQ(none.mesh.triangles, off.mesh.triangles);
}

// A box beside two spheres so close that few sites make their meshes intersect, whatever becomes of
// the box.
TEST(Features, CreasesStayWhereDroppingThemDoesNotHelpAgainstIntersections) {
    TriangleMesh inner = shapes::sphere(2);
    for (Vec3& p : inner.positions) p *= 0.98;
    for (Triangle& t : inner.triangles) std::swap(t[1], t[2]);
    const TriangleMesh spheres = shapes::join(shapes::sphere(2), inner);
    const TriangleMesh mesh =
        shapes::join(shapes::moved(spheres, {4, 0, 0}), parts::box({1, 1, 1}, 4));
    const Surface surface = build_surface(mesh.view());
    RemeshOptions options{.vertex_count = remesh::VertexCount::Add, .keep_sites = true};
    options.sites.emplace();
    for (Index v = 0; v < spheres.positions.size(); v += 7) {
        options.sites->push_back(point_at(surface, v));
    }
    for (auto v = static_cast<Index>(spheres.positions.size()); v < surface.num_vertices(); ++v) {
        options.sites->push_back(point_at(surface, v));
    }
    const RemeshResult result = remesh::remesh(mesh.view(), options);
    if (!result.self_intersections) GTEST_SKIP() << "without CGAL";
    EXPECT_GT(*result.self_intersections, 0u);
    EXPECT_EQ(result.features.curves, 12u);
    EXPECT_FALSE(result.features.gave_up);
}

TEST(Features, ScansAreLeftAlone) {
    const TriangleMesh mesh = remesh::read_mesh(std::string(AGVD_DATA_DIR) + "/organic.ply").mesh;
    const RemeshResult off =
        remesh::remesh(mesh.view(), {.num_samples = 1000, .features = Features::Off});
    const RemeshResult automatic = remesh::remesh(mesh.view(), {.num_samples = 1000});
    EXPECT_EQ(automatic.features.curves, 0u);
    EXPECT_EQ(off.mesh.positions, automatic.mesh.positions);
    EXPECT_EQ(off.mesh.triangles, automatic.mesh.triangles);
}

namespace {

TriangleMesh part_of_data() { return remesh::read_mesh(files::find_mesh("data/part.off")).mesh; }

class SharpPart : public testing::TestWithParam<const char*> {};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Features, SharpPart, testing::Values("data/part.off", "fandisk.off"));

// Faces that intersect at first are parted.
TEST(Features, CreasesStayWhereFacesIntersected) {
    const TriangleMesh mesh = part_of_data();
    const RemeshResult result = remesh::remesh(mesh.view(), {.num_samples = 250});
    expect_sound(result, 250);
    EXPECT_FALSE(result.features.gave_up);
    EXPECT_EQ(result.self_intersections.value_or(0), 0u);
}

// Without the creases that are close to others, faces of thin walls intersect.
TEST(Features, CloseCreasesComeBackWhereFacesIntersect) {
    const TriangleMesh mesh = part_of_data();
    const RemeshResult result = remesh::remesh(mesh.view(), {.num_samples = 128});
    if (!result.self_intersections) GTEST_SKIP() << "without CGAL";
    expect_sound(result, 128);
    EXPECT_EQ(*result.self_intersections, 0u);
    EXPECT_EQ(result.features.close_length, 0);
    EXPECT_EQ(result.features.freed_length, 0);
    EXPECT_FALSE(result.features.gave_up);
    const RemeshResult more = remesh::remesh(mesh.view(), {.num_samples = 300});
    EXPECT_EQ(*more.self_intersections, 0u);
    EXPECT_GT(more.features.close_length, 0);
}

// A crease gives way where faces would intersect, and nowhere else.
TEST(Features, CreasesGiveWayWhereFacesIntersect) {
    const TriangleMesh mesh = part_of_data();
    const RemeshResult result = remesh::remesh(mesh.view(), {.num_samples = 155});
    if (!result.self_intersections) GTEST_SKIP() << "without CGAL";
    expect_sound(result, 155);
    EXPECT_EQ(*result.self_intersections, 0u);
    EXPECT_FALSE(result.features.gave_up);
    EXPECT_GT(result.features.freed_length, 0);
    EXPECT_LT(result.features.freed_length, 0.15 * result.features.length);
    const agvd::ClosestPointTree tree(mesh.view());
    EXPECT_LT(std::sqrt(tree.query(result.features.freed_near).distance_sq),
              0.1 * result.sizing.mean_edge);
}

TEST_P(SharpPart, KeepsItsCreasesAndCorners) {
    const auto file = files::find_mesh(GetParam());
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no real mesh at " << file;
    const TriangleMesh mesh = remesh::read_mesh(file).mesh;
    const RemeshResult result = remesh::remesh(mesh.view(), {.num_samples = 2000});
    expect_sound(result, 2000);
    EXPECT_FALSE(result.features.gave_up);
    EXPECT_EQ(result.features.dropped_length, 0);
    EXPECT_GE(crease_checks::coverage(mesh, result.mesh, 1e-3 * diagonal(mesh)), .97);
    const std::vector<Vec3> corners = crease_checks::junctions(mesh, 40);
    EXPECT_GE(corners.size(), 8u);
    EXPECT_LT(crease_checks::farthest_from_vertices(corners, result.mesh), 1e-9 * diagonal(mesh));
}

namespace {

// Edges of a square grid of n x n cells whose ends both have y = `y`, as pairs of vertices.
std::vector<std::array<Index, 2>> edges_at(const TriangleMesh& mesh, double y) {
    std::vector<std::array<Index, 2>> edges;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            if (a < b && mesh.positions[a].y() == y && mesh.positions[b].y() == y) {
                edges.push_back({a, b});
            }
        }
    }
    return edges;
}

// Length of the result's edges that lie on y = `y`, each counted once.
double length_at(const TriangleMesh& mesh, double y) {
    double length = 0;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 &a = mesh.positions[t[k]], &b = mesh.positions[t[(k + 1) % 3]];
            if (std::abs(a.y() - y) > 1e-9 || std::abs(b.y() - y) > 1e-9) continue;
            length += (b - a).norm() / 2;  // Inner edges have two sides.
        }
    }
    return length;
}

// What the first run was given away to is there again for one with fewer creases.
TEST(Features, AMeshThatIsGivenAwayChangesNothing) {
    int num_given_up = 0;
    bool has_cgal = false;
    for (const auto& [mesh, fewest] :
         {std::pair(parts::box({1, 1, 1}, 4), Index{4}), std::pair(parts::extruded_l(6), Index{6}),
          std::pair(shapes::jitter(shapes::torus(40, 20), 0.03, 3), Index{9})}) {
        for (const Index num_samples : {fewest, Index{9}, Index{12}, Index{16}, Index{30}}) {
            const RemeshOptions options{
                .num_samples = num_samples, .features = Features::Angle, .feature_angle = 20};
            const RemeshResult kept = remesh::remesh(mesh.view(), options);
            const RemeshResult given = remesh::remesh_moved(mesh, options);
            EXPECT_EQ(kept.mesh.positions, given.mesh.positions);
            EXPECT_EQ(kept.mesh.triangles, given.mesh.triangles);
            EXPECT_EQ(kept.sites, given.sites);
            EXPECT_EQ(kept.features.gave_up, given.features.gave_up);
            num_given_up += kept.features.gave_up ? 1 : 0;
            has_cgal = kept.self_intersections.has_value();
        }
    }
    // With creases the four vertices of a box lie in one plane, so that its faces intersect.
    EXPECT_EQ(num_given_up > 0, has_cgal);
}

}  // namespace

TEST(Features, GivenEdgesAreKeptThoughTheyAreFlat) {
    const TriangleMesh plate = shapes::grid(20);
    const double y = plate.positions[plate.positions.size() / 2].y();
    const std::vector<std::array<Index, 2>> edges = edges_at(plate, y);
    ASSERT_GE(edges.size(), 10u);
    double wanted = 0;
    for (const auto& [a, b] : edges) wanted += (plate.positions[a] - plate.positions[b]).norm();
    for (const Features features : {Features::Auto, Features::Off}) {
        const RemeshResult with = remesh::remesh(
            plate.view(),
            {.num_samples = 300, .features = features, .feature_edges = edges, .num_threads = 1});
        EXPECT_EQ(with.mesh.positions.size(), 300u);
        EXPECT_NEAR(length_at(with.mesh, y), wanted, 1e-9 * wanted);
        EXPECT_NEAR(with.features.length, wanted, 1e-9 * wanted);
        EXPECT_FALSE(with.features.gave_up);
    }
    const RemeshResult without =
        remesh::remesh(plate.view(), {.num_samples = 300, .num_threads = 1});
    EXPECT_LT(length_at(without.mesh, y), 0.5 * wanted);
}

// Triangles on it cannot have a good shape, and others are not to crowd around it for that.
TEST(Features, AShortGivenEdgeLeavesTheOthersTheirShape) {
    const TriangleMesh sphere = shapes::sphere(5);
    const Triangle& t = sphere.triangles[1234];
    const double length = (sphere.positions[t[0]] - sphere.positions[t[1]]).norm();
    const RemeshOptions without{.num_samples = 500};
    RemeshOptions with = without;
    with.feature_edges = {{t[0], t[1]}};
    const RemeshResult result = remesh::remesh(sphere.view(), with);
    expect_sound(result, 500);
    EXPECT_NEAR(result.features.length, length, 1e-12);
    EXPECT_LT(length, 0.3 * std::sqrt(4 * std::numbers::pi / 500));
    const auto mean_quality = [](const RemeshResult& r) {
        return remesh::measure_triangles(r.mesh.view()).mean_quality;
    };
    const double loss = mean_quality(remesh::remesh(sphere.view(), without)) - mean_quality(result);
    EXPECT_LT(loss, 0.012);
}

TEST(Features, GivenEdgesFollowCleaning) {
    // A face that is dropped comes first, and unused vertices are left out: all numbers change.
    TriangleMesh plate = shapes::grid(20);
    const double y = plate.positions[plate.positions.size() / 2].y();
    plate.positions.insert(plate.positions.begin(), Vec3(7, 7, 7));
    for (Triangle& t : plate.triangles) {
        for (Index& v : t) ++v;
    }
    plate.triangles.insert(plate.triangles.begin(), Triangle{1, 1, 2});
    const std::vector<std::array<Index, 2>> edges = edges_at(plate, y);
    const RemeshResult result = remesh::remesh(
        plate.view(), {.num_samples = 300, .feature_edges = edges, .num_threads = 1});
    double wanted = 0;
    for (const auto& [a, b] : edges) wanted += (plate.positions[a] - plate.positions[b]).norm();
    EXPECT_NEAR(length_at(result.mesh, y), wanted, 1e-9 * wanted);
}

// A thin prism where three neighbours on a straight crease were a face.
TEST(Features, ThreeVerticesOnACreaseAreNoFace) {
    TriangleMesh prism;
    for (const double z : {0.0, 0.1402}) {
        prism.positions.insert(
            prism.positions.end(),
            {{-0.765158, 0.0555801, z}, {-0.796563, -0.0521887, z}, {0.944151, -0.0284455, z}});
    }
    prism.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4},
                       {2, 0, 3}, {2, 3, 5}, {0, 2, 1}, {3, 4, 5}};
    const RemeshResult result = remesh::remesh(prism.view(), {.num_samples = 30});
    for (const Triangle& triangle : result.mesh.triangles) {
        EXPECT_FALSE(remesh::is_flat(result.mesh.positions, triangle));
    }
    EXPECT_EQ(result.verdict.faces_without_area, 0U);
}

TEST(Features, PairsThatAreNoEdgesAreNamed) {
    const TriangleMesh plate = shapes::grid(4);
    const auto last = static_cast<Index>(plate.positions.size() - 1);
    try {
        (void)remesh::remesh(plate.view(), {.num_samples = 30, .feature_edges = {{last, 0}}});
        FAIL() << "accepted";
    } catch (const InvalidInput& error) {
        EXPECT_NE(std::string(error.what()).find("vertices 0 and " + std::to_string(last)),
                  std::string::npos)
            << error.what();
    }
}
