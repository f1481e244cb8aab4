// The Delaunay stage on what the stages before it hand on.
#include "remesh/dual/build_dual.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <set>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "agvd/propagation/propagate.h"
#include "remesh/dual/fan_mesh.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;
using remesh::Delaunay;
using remesh::DelaunayResult;

namespace {

struct Dual {
    Surface surface;
    std::vector<SurfacePoint> sites;
    Diagram diagram;
    std::vector<Triangle> triangles;

    Dual(const TriangleMesh& mesh, std::vector<SurfacePoint> points)
        : surface(build_surface(mesh.view())), sites(std::move(points)) {
        diagram = build_diagram(surface, sites, propagate(surface, sites, {.num_threads = 1}),
                                {.num_threads = 1});
        triangles = remesh::build_dual(diagram);
    }

    [[nodiscard]] DelaunayResult made(Delaunay mode, int num_threads = 1) const {
        return remesh::make_delaunay(surface, sites, positions(), triangles,
                                     {.mode = mode, .num_threads = num_threads});
    }
    // By the bounds of the distances along edges of the surface between two cells.
    [[nodiscard]] DelaunayResult made_with_bounds() const {
        const agvd::Propagation found = propagate(surface, sites, {.num_threads = 1});
        std::vector<remesh::PairBound> bounds;
        for (const Index h : surface.edge_half) {
            const Index a = surface.tail(h), b = surface.head(h);
            const auto from = found.vertex_site[a], to = found.vertex_site[b];
            if (from == to) continue;
            bounds.push_back(
                {agvd::edge_key(from.value(), to.value()),
                 found.vertex_distance[a] + surface.length_of(h) + found.vertex_distance[b]});
        }
        std::ranges::sort(bounds);
        return remesh::make_delaunay(surface, sites, positions(), triangles,
                                     {.bounds = bounds, .num_threads = 1});
    }
    [[nodiscard]] std::vector<Vec3> positions() const {
        std::vector<Vec3> result;
        for (const SurfacePoint& place : sites) {
            result.push_back(position(surface.mesh.view(), place));
        }
        return result;
    }
};

std::vector<SurfacePoint> uniform(const TriangleMesh& mesh, Index count, std::uint64_t seed) {
    return uniform_points(build_surface(mesh.view()), count, seed);
}

using Edges = std::map<std::pair<Index, Index>, int>;

Edges edges_of(const std::vector<Triangle>& triangles) {
    Edges edges;
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) ++edges[std::minmax(t[k], t[(k + 1) % 3])];
    }
    return edges;
}

std::set<std::pair<Index, Index>> boundary_of(const std::vector<Triangle>& triangles) {
    std::set<std::pair<Index, Index>> boundary;
    for (const auto& [ends, count] : edges_of(triangles)) {
        if (count == 1) boundary.insert(ends);
    }
    return boundary;
}

void expect_same_surface(const Dual& dual, const DelaunayResult& result) {
    const std::vector<Vec3> p = dual.positions();
    const auto before = remesh::analyze_topology({p, dual.triangles});
    const auto after = remesh::analyze_topology({p, result.triangles});
    EXPECT_EQ(before.is_manifold, after.is_manifold);
    EXPECT_EQ(before.is_oriented, after.is_oriented);
    if (before.is_manifold) {
        EXPECT_TRUE(same_topology(before, after));
    }
    EXPECT_EQ(boundary_of(dual.triangles), boundary_of(result.triangles));
    if (!before.is_manifold) return;
    std::map<Index, int> valence;
    for (const auto& [ends, count] : edges_of(result.triangles)) {
        ++valence[ends.first];
        ++valence[ends.second];
    }
    std::set<Index> on_boundary;
    for (const auto& [a, b] : boundary_of(result.triangles)) on_boundary.insert({a, b});
    for (const auto& [v, count] : valence) EXPECT_GE(count, on_boundary.contains(v) ? 2 : 3);
}

}  // namespace

TEST(MakeDelaunay, HoldsOnRandomMeshesWhateverTheDual) {
    const std::uint64_t num_seeds = std::getenv("AGVD_LONG") != nullptr ? 500 : 30;
    std::size_t num_edges = 0, num_unproved = 0;
    for (const char* family : random_meshes::families()) {
        for (std::uint64_t seed = 1; seed <= num_seeds; ++seed) {
            SCOPED_TRACE(std::string(family) + ' ' + std::to_string(seed));
            const TriangleMesh mesh = random_meshes::make(family, seed);
            Dice dice(seed);
            const Dual dual(
                mesh, seed % 2 == 0
                          ? points::random_sites(dice, static_cast<Index>(mesh.triangles.size()))
                          : uniform(mesh, dice.count(4, 150), seed));
            for (const Delaunay mode : {Delaunay::Intrinsic, Delaunay::Extrinsic}) {
                const DelaunayResult result = dual.made(mode);
                expect_same_surface(dual, result);
                EXPECT_TRUE(result.counts.is_finished);
                if (mode == Delaunay::Extrinsic) continue;
                num_edges += result.counts.inner_edges;
                num_unproved += result.counts.not_locally_shortest;
            }
        }
    }
    // Rounding hides it on faces of no height.
    EXPECT_LE(num_unproved, num_edges / 5000);
}

TEST(MakeDelaunay, BoundsSaveLengthsAndChangeNothing) {
    Index num_failing = 0;
    for (const TriangleMesh& mesh :
         {shapes::jitter(shapes::sphere(5), 0.003, 1), shapes::torus(90, 45),
          shapes::jitter(shapes::grid(60), 0.004, 2)}) {
        for (const Index count : {60U, 300U}) {
            const Dual dual(mesh, uniform(mesh, count, count));
            const DelaunayResult all = dual.made(Delaunay::Intrinsic);
            const DelaunayResult some = dual.made_with_bounds();
            EXPECT_EQ(some.triangles, all.triangles);
            EXPECT_EQ(some.counts.failing_before, all.counts.failing_before);
            EXPECT_EQ(some.counts.failing_after, all.counts.failing_after);
            EXPECT_EQ(some.counts.flips, all.counts.flips);
            EXPECT_EQ(some.counts.broken_triangles, all.counts.broken_triangles);
            EXPECT_GE(all.counts.measured_edges, all.counts.inner_edges);  // And the boundary.
            EXPECT_LT(some.counts.measured_edges, all.counts.measured_edges);
            num_failing += all.counts.failing_before;
        }
    }
    EXPECT_GT(num_failing, 5u);
}

// In space the third vertex is nearer to the second one than on the surface: by these lengths the
// angle at it would be 3.5 degrees, not 36.
TEST(MakeDelaunay, BoundsProveNothingBesideObtuseCorners) {
    const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1.3, 0.4, 0}, {0.5, -0.12, 0}},
                            {{0, 1, 2}, {1, 0, 3}}};
    const Surface surface = build_surface(mesh.view());
    std::vector<SurfacePoint> points;
    for (Index v = 0; v < 4; ++v) points.push_back(point_at(surface, v));
    std::vector<Vec3> positions = mesh.positions;
    positions[2] = {1.3595, 0.03, 0};
    std::vector<remesh::PairBound> bounds;
    for (const Index h : surface.edge_half) {
        bounds.push_back({agvd::edge_key(surface.tail(h), surface.head(h)), surface.length_of(h)});
    }
    std::ranges::sort(bounds);
    for (const std::span<const remesh::PairBound> given :
         {std::span(bounds).first(0), std::span(bounds)}) {
        const DelaunayResult result = remesh::make_delaunay(
            surface, points, positions, mesh.triangles, {.bounds = given, .num_threads = 1});
        EXPECT_EQ(result.counts.failing_before, 1u);
    }
}

TEST(MakeDelaunay, InThePlaneEveryEdgeIsDelaunay) {
    TriangleMesh mesh = shapes::jitter(shapes::grid(30), 0.01, 2);
    for (Vec3& p : mesh.positions) p.z() = 0;
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const Dual dual(mesh, uniform(mesh, 200, seed));
        for (const Delaunay mode : {Delaunay::Intrinsic, Delaunay::Extrinsic}) {
            const DelaunayResult result = dual.made(mode);
            EXPECT_EQ(result.counts.failing_after, 0u);
            EXPECT_GT(result.counts.inner_edges, 400u);
            expect_same_surface(dual, result);
        }
    }
}

// Not the dual any more, as after edges were collapsed or flipped: paths are found all the same.
TEST(MakeDelaunay, MendsEdgesThatAreDualToNothing) {
    TriangleMesh mesh = shapes::jitter(shapes::grid(30), 0.01, 2);
    for (Vec3& p : mesh.positions) p.z() = 0;
    Dual dual(mesh, uniform(mesh, 150, 5));
    const std::size_t dual_failing = dual.made(Delaunay::Intrinsic).counts.failing_before;
    // The fan around every tenth vertex inside is triangulated anew from one of its neighbours.
    const std::set<std::pair<Index, Index>> boundary = boundary_of(dual.triangles);
    std::set<Index> fixed;
    for (const auto& [a, b] : boundary) fixed.insert({a, b});
    Index removed = 0;
    for (Index v = 0; v < dual.sites.size(); v += 10) {
        if (fixed.contains(v)) continue;
        std::map<Index, Index> next;
        for (const Triangle& t : dual.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (t[k] == v) next[t[(k + 1) % 3]] = t[(k + 2) % 3];
            }
        }
        const Edges edges = edges_of(dual.triangles);
        for (const auto& [start, second] : next) {
            std::vector<Triangle> fan;
            bool is_free = true;
            for (Index a = second, b = next[a]; b != start; a = b, b = next[b]) {
                fan.push_back({start, a, b});
                if (next[b] != start) is_free = is_free && !edges.contains(std::minmax(start, b));
            }
            if (!is_free) continue;
            std::erase_if(dual.triangles,
                          [&](const Triangle& t) { return t[0] == v || t[1] == v || t[2] == v; });
            dual.triangles.insert(dual.triangles.end(), fan.begin(), fan.end());
            ++removed;
            break;
        }
    }
    ASSERT_GT(removed, 5u);
    const DelaunayResult result = dual.made(Delaunay::Intrinsic);
    EXPECT_GT(result.counts.failing_before, dual_failing);
    EXPECT_GT(result.counts.flips, 0u);
    EXPECT_EQ(result.counts.failing_after, 0u);
    expect_same_surface(dual, result);
}

TEST(MakeDelaunay, MendsFlipsMadeAtRandom) {
    const TriangleMesh mesh = shapes::jitter(shapes::torus(60, 30), 0.005, 1);
    Dual dual(mesh, uniform(mesh, 500, 4));
    const Index unmended = dual.made(Delaunay::Intrinsic).counts.failing_after;
    remesh::detail::FanMesh flipped(dual.triangles, static_cast<Index>(dual.sites.size()));
    std::vector<std::pair<Index, Index>> edges;
    for (const auto& [ends, count] : edges_of(dual.triangles)) edges.push_back(ends);
    Dice dice(1);
    for (int i = 0; i < 300; ++i) {
        auto& [a, b] = edges[dice.count(0, static_cast<Index>(edges.size()) - 1)];
        const Index h = flipped.half_edge(a, b);
        if (!flipped.can_flip(h)) continue;
        a = flipped.apex(h);
        b = flipped.apex(flipped.twin(h));
        flipped.flip(h);
    }
    dual.triangles = flipped.triangles();
    const DelaunayResult result = dual.made(Delaunay::Intrinsic);
    EXPECT_GT(result.counts.failing_before, 100u);
    EXPECT_LE(result.counts.failing_after, unmended + result.counts.failing_before / 20);
    EXPECT_EQ(result.counts.not_locally_shortest, 0u);
    expect_same_surface(dual, result);
}

TEST(MakeDelaunay, SameBytesForAnyThreadCount) {
    const TriangleMesh mesh = shapes::jitter(shapes::torus(60, 30), 0.03, 3);
    const Dual dual(mesh, uniform(mesh, 300, 1));
    const DelaunayResult one = dual.made(Delaunay::Intrinsic, 1);
    EXPECT_GT(one.counts.flips, 0u);
    for (const int threads : {2, 8}) {
        const DelaunayResult other = dual.made(Delaunay::Intrinsic, threads);
        EXPECT_EQ(one.triangles, other.triangles);
    }
}

TEST(MakeDelaunay, OffLeavesTheTriangles) {
    const TriangleMesh mesh = shapes::sphere(3);
    const Dual dual(mesh, uniform(mesh, 100, 1));
    const DelaunayResult result = dual.made(Delaunay::Off);
    EXPECT_EQ(result.triangles, dual.triangles);
    EXPECT_EQ(result.counts.inner_edges, 0u);
}

namespace {

// Triangles (0, 1, 2) and (1, 0, 3): the edge from 0 to 1 is long, so that it fails.
struct Quad {
    std::vector<Triangle> triangles{{0, 1, 2}, {1, 0, 3}};
    std::vector<Vec3> positions{{0, 0, 0}, {4, 0, 0}, {2, 1, 0}, {2, -1, 0}};

    [[nodiscard]] DelaunayResult flipped() const {
        return remesh::make_delaunay({}, {}, positions, triangles, {.mode = Delaunay::Extrinsic});
    }
};

}  // namespace

TEST(MakeDelaunay, FlipsALongDiagonal) {
    const DelaunayResult result = Quad().flipped();
    EXPECT_EQ(result.counts.flips, 1u);
    EXPECT_TRUE(result.counts.is_finished);
    const Edges edges = edges_of(result.triangles);
    EXPECT_TRUE(edges.contains({2, 3}));
    EXPECT_FALSE(edges.contains({0, 1}));
}

TEST(MakeDelaunay, TurnsNoTriangleOver) {
    Quad quad;
    quad.positions[0] = {3, 0, 0};  // No longer convex: 0 lies beyond the line from 2 to 3.
    EXPECT_EQ(quad.flipped().counts.flips, 0u);
    quad.positions[0] = {1, 0, 0};
    EXPECT_EQ(quad.flipped().counts.flips, 1u);
}

TEST(MakeDelaunay, RepeatsNoEdge) {
    Quad quad;
    // Closed below by two faces that have the edge from 2 to 3 already.
    quad.triangles.insert(quad.triangles.end(), {{0, 2, 3}, {2, 1, 3}});
    EXPECT_EQ(quad.flipped().triangles, quad.triangles);
}

TEST(MakeDelaunay, LeavesEdgesAloneThatThreeTrianglesShare) {
    Quad quad;
    quad.positions.push_back({2, 0, 1});
    quad.triangles.push_back({0, 1, 4});
    EXPECT_EQ(quad.flipped().triangles, quad.triangles);
}
