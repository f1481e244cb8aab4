// Vertices and edges of the input that stay in the result.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "agvd/core/error.h"
#include "agvd/mesh/topology.h"
#include "remesh/clean/clean_input.h"
#include "remesh/pipeline/locked.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"
#include "support/dice.h"
#include "support/dirty_shapes.h"
#include "support/junction_shapes.h"
#include "support/parts.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::RemeshOptions;
using remesh::RemeshResult;

namespace {

using BitsOfPoint = std::array<std::uint64_t, 3>;

BitsOfPoint bits(const Vec3& p) {
    return {std::bit_cast<std::uint64_t>(p.x()), std::bit_cast<std::uint64_t>(p.y()),
            std::bit_cast<std::uint64_t>(p.z())};
}

// Checks that the locked vertices, the number of vertices and the topology are kept.
RemeshResult expect_locked(const TriangleMesh& mesh, const RemeshOptions& options) {
    RemeshResult result = remesh::remesh(mesh.view(), options);
    std::set<BitsOfPoint> positions;
    for (const Vec3& p : result.mesh.positions) positions.insert(bits(p));
    for (const Index v : options.locked) {
        EXPECT_TRUE(positions.contains(bits(mesh.positions[v]))) << v;
    }
    EXPECT_EQ(result.mesh.positions.size(), options.num_samples);
    const remesh::Topology topology = remesh::analyze_topology(result.mesh.view());
    EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
    EXPECT_TRUE(remesh::same_topology(topology, result.input_topology));
    return result;
}

std::vector<Index> random_vertices(const TriangleMesh& mesh, Index count, std::uint64_t seed) {
    Dice dice(seed);
    std::vector<Index> vertices;
    const auto last = static_cast<Index>(mesh.positions.size() - 1);
    for (Index i = 0; i < count; ++i) vertices.push_back(dice.count(0, last));
    return vertices;
}

double least_degrees(const RemeshResult& result) {
    return remesh::measure_triangles(result.mesh.view()).min_angle * 180 / std::numbers::pi;
}

}  // namespace

TEST(Locked, VerticesInsideFacesStay) {
    int num_tried = 0;
    for (const auto& mesh :
         {shapes::sphere(4), shapes::torus(48, 24), shapes::jitter(shapes::sphere(4), 0.02, 5)}) {
        for (const Index count : {1u, 20u, 100u}) {
            for (const int steps : {60, 0}) {
                SCOPED_TRACE(count);
                const RemeshResult result =
                    expect_locked(mesh, {.num_samples = 500,
                                         .locked = random_vertices(mesh, count, count),
                                         .relax_steps = steps});
                if (steps > 0 && count <= 20) {
                    EXPECT_GT(least_degrees(result), 20);
                }
                ++num_tried;
            }
        }
    }
    EXPECT_EQ(num_tried, 18);
}

TEST(Locked, VerticesOfCreasesAndBoundariesStay) {
    const TriangleMesh box = parts::box({1, 1, 1}, 9);
    std::vector<Index> on_crease, anywhere;
    for (Index v = 0; v < box.positions.size(); ++v) {
        const Vec3& p = box.positions[v];
        if (p.x() == 0 && p.y() == 0 && (p.z() > 0.2 && p.z() < 0.5)) on_crease.push_back(v);
        if (v % 7 == 0) anywhere.push_back(v);
    }
    ASSERT_GE(on_crease.size(), 2u);
    expect_locked(box, {.num_samples = 400, .locked = on_crease});
    const RemeshResult creases = expect_locked(box, {.num_samples = 900, .locked = anywhere});
    EXPECT_NEAR(shapes::signed_volume(creases.mesh), 1, 1e-9);
    const TriangleMesh grid = shapes::grid(15);
    for (const remesh::Boundary boundary : {remesh::Boundary::Keep, remesh::Boundary::Free}) {
        expect_locked(
            grid,
            {.num_samples = 300, .boundary = boundary, .locked = random_vertices(grid, 40, 3)});
    }
    for (const remesh::Init init : {remesh::Init::Random, remesh::Init::Farthest}) {
        expect_locked(grid, {.num_samples = 300,
                             .init = init,
                             .features = remesh::Features::Off,
                             .locked = random_vertices(grid, 40, 3)});
    }
}

TEST(Locked, AllVerticesMayStay) {
    const TriangleMesh mesh = shapes::sphere(3);
    RemeshOptions options{.num_samples = static_cast<Index>(mesh.positions.size())};
    for (Index v = 0; v < options.num_samples; ++v) options.locked.push_back(v);
    expect_locked(mesh, options);
    --options.num_samples;
    EXPECT_THROW((void)remesh::remesh(mesh.view(), options), agvd::ConstraintUnmet);
    // A number that follows from lengths is raised.
    options.sizing.count = remesh::MeanEdge{1};
    EXPECT_EQ(remesh::remesh(mesh.view(), options).mesh.positions.size(), mesh.positions.size());
}

TEST(Locked, EdgesStay) {
    const TriangleMesh mesh = shapes::sphere(4);
    RemeshOptions options{.num_samples = 400};
    // Three chains of inner edges: each vertex follows the first corner of a face of the last.
    for (const Index face : {0u, 1000u, 4000u}) {
        const auto& [a, b, c] = mesh.triangles[face];
        options.locked_edges.push_back({a, b});
        options.locked_edges.push_back({b, c});
        options.locked.insert(options.locked.end(), {a, b, c});
    }
    const RemeshResult result = expect_locked(mesh, options);
    std::set<std::pair<BitsOfPoint, BitsOfPoint>> edges;
    for (const agvd::Triangle& t : result.mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            edges.insert(std::minmax(bits(result.mesh.positions[t[k]]),
                                     bits(result.mesh.positions[t[(k + 1) % 3]])));
        }
    }
    for (const auto& [a, b] : options.locked_edges) {
        EXPECT_TRUE(edges.contains(std::minmax(bits(mesh.positions[a]), bits(mesh.positions[b]))));
    }
}

TEST(Locked, MinusZeroStays) {
    TriangleMesh mesh = shapes::sphere(3);
    Index zero = 0;
    for (Index v = 0; v < mesh.positions.size(); ++v) {
        if (mesh.positions[v].z() == 0) zero = v;
    }
    ASSERT_EQ(mesh.positions[zero].z(), 0);
    mesh.positions[zero].z() = -0.0;
    expect_locked(mesh, {.num_samples = 100, .locked = {zero}});
}

TEST(Locked, VerticesOfOneRegionStay) {
    const TriangleMesh mesh = shapes::sphere(4);
    RemeshOptions options{.num_samples = 600, .locked = random_vertices(mesh, 60, 1)};
    for (const auto& [a, b, c] : mesh.triangles) {
        options.region.push_back(mesh.positions[a].z() > 0.1 ? 1 : 0);
    }
    const RemeshResult result = remesh::remesh(mesh.view(), options);
    std::set<BitsOfPoint> positions;
    for (const Vec3& p : result.mesh.positions) positions.insert(bits(p));
    int num_inside = 0;
    for (const Index v : options.locked) {
        EXPECT_TRUE(positions.contains(bits(mesh.positions[v])));
        if (mesh.positions[v].z() > 0.2) ++num_inside;
    }
    EXPECT_GT(num_inside, 10);
    EXPECT_TRUE(remesh::analyze_topology(result.mesh.view()).is_manifold);
}

TEST(Locked, WhatTheResultLostIsNoticed) {
    using remesh::detail::find_locked;
    using remesh::detail::has_locked;
    const agvd::TriangleMesh cube = shapes::cube();
    const agvd::Surface surface = agvd::build_surface(cube.view());
    const agvd::Index h = surface.edge_half[0];
    const agvd::Index a = surface.tail(h), b = surface.head(h);
    const remesh::LockedElements corners = find_locked(cube.view(), {.locked = {a, b}}, surface);
    const remesh::LockedElements edge =
        find_locked(cube.view(), {.locked_edges = {{a, b}}}, surface);
    agvd::TriangleMesh result = cube;
    EXPECT_TRUE(has_locked(surface, corners, result));
    EXPECT_TRUE(has_locked(surface, edge, result));
    result.positions[b].x() += 1e-9;
    EXPECT_FALSE(has_locked(surface, corners, result));
    EXPECT_FALSE(has_locked(surface, edge, result));
    result = cube;  // Both vertices are there, but not the edge.
    std::erase_if(result.triangles, [&](const agvd::Triangle& t) {
        return std::count(t.begin(), t.end(), a) + std::count(t.begin(), t.end(), b) == 2;
    });
    EXPECT_TRUE(has_locked(surface, corners, result));
    EXPECT_FALSE(has_locked(surface, edge, result));
}

// Where sheets meet, cleaning has cut the mesh: that is no boundary of the caller's.
TEST(Locked, TheBoundaryIsWhereAnEdgeHasOneFace) {
    for (const shapes::JunctionShape& shape : {shapes::tee(), shapes::cubes_with_a_wall()}) {
        std::map<std::pair<Index, Index>, int> num_faces;
        for (const agvd::Triangle& t : shape.mesh.triangles) {
            for (std::size_t k = 0; k < 3; ++k) ++num_faces[std::minmax(t[k], t[(k + 1) % 3])];
        }
        const auto expected = std::count_if(num_faces.begin(), num_faces.end(),
                                            [](const auto& edge) { return edge.second == 1; });
        const agvd::Surface surface =
            agvd::build_surface(remesh::clean_input(shape.mesh.view()).mesh.view());
        const remesh::LockedElements locked =
            remesh::detail::find_locked({}, {.lock_boundary = true}, surface);
        EXPECT_EQ(std::count(locked.is_edge.begin(), locked.is_edge.end(), 1), expected)
            << shape.name;
    }
    EXPECT_THROW(static_cast<void>(remesh::remesh(
                     shapes::grid(3).view(),
                     {.lock_boundary = true, .sites = std::vector<agvd::SurfacePoint>(1)})),
                 agvd::InvalidOption);
}

TEST(Locked, CoordinatesOfAnySizeStay) {
    for (const double factor : {1e-200, 1e150}) {
        TriangleMesh mesh = shapes::sphere(3);
        for (Vec3& p : mesh.positions) p *= factor;
        expect_locked(mesh, {.num_samples = 150, .locked = random_vertices(mesh, 20, 2)});
    }
}

TEST(Locked, WeldedVerticesStay) {
    const TriangleMesh mesh = shapes::unweld(shapes::sphere(3));
    const std::vector<Index> locked = random_vertices(mesh, 30, 4);
    expect_locked(mesh, {.num_samples = 200, .locked = locked});
}

TEST(Locked, WhatIsNotThereIsRefused) {
    TriangleMesh mesh = shapes::sphere(2);
    const auto count = static_cast<Index>(mesh.positions.size());
    const auto text_of = [&](const RemeshOptions& options) {
        try {
            (void)remesh::remesh(mesh.view(), options);
        } catch (const agvd::InvalidInput& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    const auto minus_one = static_cast<Index>(-1);
    EXPECT_NE(text_of({.num_samples = 50, .locked = {minus_one}}).find("vertex -1 is"),
              std::string::npos);
    for (const RemeshOptions& options :
         {RemeshOptions{.num_samples = 50, .feature_edges = {{minus_one, 0}}},
          RemeshOptions{.num_samples = 50, .locked_edges = {{minus_one, 0}}}}) {
        EXPECT_NE(text_of(options).find("-1"), std::string::npos) << text_of(options);
        EXPECT_EQ(text_of(options).find("4294967295"), std::string::npos) << text_of(options);
    }
    EXPECT_NE(text_of({.num_samples = 50, .locked = {count}})
                  .find("vertex " + std::to_string(count) + " is to stay, but the mesh has only"),
              std::string::npos);
    mesh.positions.emplace_back(5, 5, 5);
    EXPECT_NE(text_of({.num_samples = 50, .locked = {count}}).find("no face"), std::string::npos);
    EXPECT_NE(text_of({.num_samples = 50, .locked_edges = {{0, 1}}}).find("not an edge"),
              std::string::npos);
    RemeshOptions with_sites{.locked = {0}};
    with_sites.sites.emplace();
    EXPECT_THROW((void)remesh::remesh(mesh.view(), with_sites), agvd::InvalidOption);
}

TEST(Locked, AnyNumberOfThreadsGivesTheSameBytes) {
    const TriangleMesh mesh = shapes::torus(48, 24);
    RemeshOptions options{
        .num_samples = 400, .locked = random_vertices(mesh, 50, 9), .num_threads = 1};
    const RemeshResult one = remesh::remesh(mesh.view(), options);
    for (const int threads : {2, 8}) {
        options.num_threads = threads;
        const RemeshResult more = remesh::remesh(mesh.view(), options);
        EXPECT_EQ(more.mesh.positions, one.mesh.positions);
        EXPECT_EQ(more.mesh.triangles, one.mesh.triangles);
    }
}

// Cleaning welds vertices that differ by rounding: those that are locked stay where it puts them.
TEST(Locked, VerticesThatWeldingMovesStayAtTheirPlace) {
    const TriangleMesh model = shapes::torus(30, 20);
    const TriangleMesh soup = shapes::jitter(shapes::unweld(model), 1e-8, 3);
    RemeshOptions options{.num_samples = 300};
    for (Index v = 0; v < soup.positions.size(); v += 97) options.locked.push_back(v);
    const RemeshResult result = remesh::remesh(soup.view(), options);
    EXPECT_EQ(result.mesh.positions.size(), 300u);
    for (const Index v : options.locked) {
        double least = 1;
        for (const Vec3& p : result.mesh.positions) {
            least = std::min(least, (p - soup.positions[v]).norm());
        }
        EXPECT_LE(least, 1e-7) << v;
    }
}
