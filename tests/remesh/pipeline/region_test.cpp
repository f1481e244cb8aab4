// A part of a mesh is remeshed; the rest stays as it was, and the seam closes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include "agvd/core/error.h"
#include "agvd/mesh/topology.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"
#include "support/dice.h"
#include "support/dirty_shapes.h"
#include "support/files.h"
#include "support/junction_shapes.h"
#include "support/parts.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Triangle;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::RemeshOptions;
using remesh::RemeshResult;

namespace {

using Bits = std::array<std::uint64_t, 3>;
using Mask = std::vector<std::uint8_t>;

Bits bits_of(const Vec3& p) {
    return {std::bit_cast<std::uint64_t>(p.x()), std::bit_cast<std::uint64_t>(p.y()),
            std::bit_cast<std::uint64_t>(p.z())};
}

std::array<Bits, 3> corners(const TriangleMesh& mesh, Index face) {
    const auto& [a, b, c] = mesh.triangles[face];
    return {bits_of(mesh.positions[a]), bits_of(mesh.positions[b]), bits_of(mesh.positions[c])};
}

Mask mask_of(const TriangleMesh& mesh, const std::function<bool(const Vec3&)>& is_inside) {
    Mask mask;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 middle = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3;
        mask.push_back(is_inside(middle) ? 1 : 0);
    }
    return mask;
}

Mask upper_half(const TriangleMesh& mesh) {
    return mask_of(mesh, [](const Vec3& p) { return p.z() > 0; });
}

Mask random_mask(const TriangleMesh& mesh, double share, std::uint64_t seed) {
    Dice dice(seed);
    Mask mask;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        mask.push_back(dice.number(0, 1) < share ? 1 : 0);
    }
    mask.front() = 1;
    mask.back() = 0;
    return mask;
}

// The numbers of faces of each kind at an edge: inside, outside.
using FacesAtEdge = std::map<std::pair<Bits, Bits>, std::pair<int, int>>;

// Edges that have both, by the positions of their ends.
FacesAtEdge seam_of(const TriangleMesh& mesh, const std::function<bool(Index)>& is_inside) {
    FacesAtEdge at;
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const std::array<Bits, 3> p = corners(mesh, f);
        for (std::size_t k = 0; k < 3; ++k) {
            auto& [inside, outside] = at[std::minmax(p[k], p[(k + 1) % 3])];
            ++(is_inside(f) ? inside : outside);
        }
    }
    std::erase_if(
        at, [](const auto& entry) { return entry.second.first == 0 || entry.second.second == 0; });
    return at;
}

// Checks everything that a region promises, for any mesh, and returns the result.
RemeshResult expect_region(const TriangleMesh& mesh, const Mask& mask, RemeshOptions options) {
    options.region = mask;
    options.num_threads = 1;
    RemeshResult result = remesh::remesh(mesh.view(), options);
    std::vector<Index> kept;
    std::set<Index> kept_vertices;
    for (Index f = 0; f < mask.size(); ++f) {
        if (mask[f] != 0) continue;
        kept.push_back(f);
        for (const Index v : mesh.triangles[f]) kept_vertices.insert(v);
    }
    EXPECT_EQ(result.kept.faces, kept);
    EXPECT_EQ(result.kept.vertices, std::vector<Index>(kept_vertices.begin(), kept_vertices.end()));
    EXPECT_EQ(result.sites.size(), result.mesh.positions.size());
    bool is_same = true;
    for (Index i = 0; i < kept.size(); ++i) {
        is_same = is_same && corners(result.mesh, i) == corners(mesh, kept[i]);
    }
    EXPECT_TRUE(is_same);
    for (Index v = 0; v < result.kept.vertices.size(); ++v) {
        const Vec3& p = mesh.positions[result.kept.vertices[v]];
        EXPECT_EQ(bits_of(result.mesh.positions[v]), bits_of(p));
        EXPECT_EQ(agvd::position(mesh.view(), result.sites[v]), p);
    }
    const FacesAtEdge before = seam_of(mesh, [&](Index f) { return mask[f] != 0; });
    const FacesAtEdge after = seam_of(result.mesh, [&](Index f) { return f >= kept.size(); });
    EXPECT_EQ(after, before);
    EXPECT_EQ(result.kept.rim_edges, before.size());
    return result;
}

// The same for a manifold: the result is one of the same topology.
RemeshResult expect_manifold_region(const TriangleMesh& mesh, const Mask& mask,
                                    const RemeshOptions& options) {
    RemeshResult result = expect_region(mesh, mask, options);
    const remesh::Topology before = remesh::analyze_topology(mesh.view());
    const remesh::Topology after = remesh::analyze_topology(result.mesh.view());
    EXPECT_TRUE(after.is_manifold);
    EXPECT_TRUE(after.is_oriented);
    EXPECT_TRUE(remesh::same_topology(before, after));
    return result;
}

// The faces that are new.
TriangleMesh new_part(const RemeshResult& result) {
    const auto& triangles = result.mesh.triangles;
    return {result.mesh.positions,
            {triangles.begin() + static_cast<std::ptrdiff_t>(result.kept.faces.size()),
             triangles.end()}};
}

std::size_t num_vertices_of(const TriangleMesh& part) {
    std::set<Index> vertices;
    for (const Triangle& t : part.triangles) vertices.insert(t.begin(), t.end());
    return vertices.size();
}

// Degrees.
double least_angle(const TriangleMesh& part) {
    return remesh::measure_triangles(part.view()).min_angle * 180 / std::numbers::pi;
}

std::vector<std::pair<const char*, TriangleMesh>> shapes_to_try() {
    return {{"sphere", shapes::sphere(4)},
            {"bumpy sphere", shapes::jitter(shapes::sphere(4), 0.02, 3)},
            {"torus", shapes::torus(48, 24)},
            {"box", shapes::moved(parts::box({1, 1, 1}, 10), {0, 0, -0.52})},
            {"tube", shapes::moved(shapes::tube(32, 16), {0, 0, -0.4})},
            {"grid", parts::turned(shapes::grid(20), 5)}};
}

// Two rows of the grid, or what else there is: never all faces.
Mask half_of(const TriangleMesh& mesh) {
    Vec3 middle = Vec3::Zero();
    for (const Vec3& p : mesh.positions) middle += p / static_cast<double>(mesh.positions.size());
    return mask_of(mesh, [&](const Vec3& p) { return (p - middle).dot(Vec3(1, .3, .7)) > 0.03; });
}

}  // namespace

TEST(Region, HalfOfAShapeIsRemeshedAndTheSeamCloses) {
    int num_tried = 0;
    for (const auto& [name, mesh] : shapes_to_try()) {
        const Mask mask = half_of(mesh);
        for (const Index count : {300u, 800u}) {
            SCOPED_TRACE(std::string(name) + ' ' + std::to_string(count));
            const RemeshResult result = expect_manifold_region(mesh, mask, {.num_samples = count});
            EXPECT_EQ(num_vertices_of(new_part(result)), count);
            ++num_tried;
        }
    }
    EXPECT_EQ(num_tried, 12);
}

TEST(Region, AnyFacesAreARegion) {
    int num_tried = 0;
    for (const auto& [name, mesh] : shapes_to_try()) {
        for (const double share : {0.02, 0.3, 0.6, 0.95}) {
            for (const std::uint64_t seed : {1u, 2u}) {
                SCOPED_TRACE(std::string(name) + ' ' + std::to_string(share));
                const Mask mask = random_mask(mesh, share, seed);
                expect_manifold_region(mesh, mask, {.sizing = {.count = remesh::MeanEdge{0.25}}});
                ++num_tried;
            }
        }
    }
    EXPECT_EQ(num_tried, 48);
}

TEST(Region, ManyVerticesInScatteredFaces) {
    const TriangleMesh mesh = shapes::sphere(2);
    int num_tried = 0;
    for (const double share : {0.1, 0.5}) {
        SCOPED_TRACE(share);
        expect_manifold_region(mesh, random_mask(mesh, share, 7), {.num_samples = 900});
        ++num_tried;
    }
    EXPECT_EQ(num_tried, 2);
}

TEST(Region, AWholeComponentComesOutAsAlone) {
    const TriangleMesh one = shapes::sphere(3);
    const TriangleMesh two = shapes::join(shapes::moved(one, {5, 0, 0}), one);
    Mask mask(two.triangles.size(), 0);
    std::fill(mask.begin() + static_cast<std::ptrdiff_t>(one.triangles.size()), mask.end(), 1);
    const RemeshResult part = expect_manifold_region(two, mask, {.num_samples = 200});
    const RemeshResult alone = remesh::remesh(one.view(), {.num_samples = 200, .num_threads = 1});
    EXPECT_EQ(part.kept.rim_edges, 0u);
    for (Index v = 0; v < 200; ++v) {
        const Index moved = v + static_cast<Index>(one.positions.size());
        EXPECT_EQ(bits_of(part.mesh.positions[moved]), bits_of(alone.mesh.positions[v]));
    }
}

TEST(Region, AllFacesAreNoRegion) {
    const TriangleMesh mesh = shapes::torus(24, 12);
    const RemeshResult whole = remesh::remesh(mesh.view(), {.num_samples = 300});
    const RemeshResult all =
        remesh::remesh(mesh.view(), {.num_samples = 300, .region = Mask(mesh.triangles.size(), 7)});
    EXPECT_EQ(all.mesh.positions, whole.mesh.positions);
    EXPECT_EQ(all.mesh.triangles, whole.mesh.triangles);
    EXPECT_TRUE(all.kept.faces.empty());
}

TEST(Region, NoFacesAndOptionsThatDoNotFitAreRefused) {
    const TriangleMesh mesh = shapes::sphere(2);
    const Mask none(mesh.triangles.size(), 0);
    EXPECT_THROW((void)remesh::remesh(mesh.view(), {.region = none}), agvd::InvalidOption);
    EXPECT_THROW((void)remesh::remesh(mesh.view(), {.region = Mask(3, 1)}), agvd::InvalidOption);
    const Mask half = upper_half(mesh);
    EXPECT_THROW((void)remesh::remesh(mesh.view(), {.drop_components = 0.1, .region = half}),
                 agvd::InvalidOption);
    RemeshOptions with_sites{.region = half};
    with_sites.sites.emplace();
    EXPECT_THROW((void)remesh::remesh(mesh.view(), with_sites), agvd::InvalidOption);
}

TEST(Region, ASingleFaceMayComeOutAsItWas) {
    const TriangleMesh mesh = shapes::sphere(1);
    Mask mask(mesh.triangles.size(), 0);
    mask[5] = 1;
    const RemeshResult result = expect_manifold_region(mesh, mask, {.num_samples = 3});
    EXPECT_EQ(result.mesh.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(result.mesh.positions, mesh.positions);
    EXPECT_EQ(expect_manifold_region(mesh, mask, {.num_samples = 4}).mesh.triangles.size(),
              mesh.triangles.size() + 2);
}

TEST(Region, PartsThatTouchAtAVertexStayJoinedThere) {
    const TriangleMesh mesh = shapes::grid(8);  // On [0, 1]^2.
    const auto in_square = [](const Vec3& p, double low, double high) {
        return p.x() > low && p.x() < high && p.y() > low && p.y() < high;
    };
    const Mask mask = mask_of(
        mesh, [&](const Vec3& p) { return in_square(p, 0.25, 0.5) || in_square(p, 0.5, 0.75); });
    ASSERT_EQ(std::count(mask.begin(), mask.end(), 1), 16);
    const RemeshResult result =
        expect_manifold_region(mesh, mask, {.sizing = {.count = remesh::MeanEdge{0.05}}});
    EXPECT_GT(new_part(result).triangles.size(), 16u);
}

TEST(Region, TooFewVerticesAreAnErrorThatNamesEnough) {
    const TriangleMesh mesh = shapes::sphere(4);
    const Mask mask = upper_half(mesh);
    std::string text;
    try {
        (void)remesh::remesh(mesh.view(), {.num_samples = 20, .region = mask});
    } catch (const agvd::ConstraintUnmet& error) {
        text = error.what();
    }
    const std::size_t at = text.find("use ");
    ASSERT_NE(at, std::string::npos) << text;
    const auto enough = static_cast<Index>(std::stoul(text.substr(at + 4)));
    EXPECT_GE(enough, 20u);
    expect_manifold_region(mesh, mask, {.num_samples = enough});
}

TEST(Region, EdgesGrowFromAFineSeam) {
    const TriangleMesh mesh = shapes::sphere(5);
    const RemeshResult result = expect_manifold_region(
        mesh, upper_half(mesh), {.sizing = {.count = remesh::MeanEdge{0.3}}});
    const TriangleMesh part = new_part(result);
    EXPECT_GT(least_angle(part), 24);
    // Less than half of the input's 10 000 faces there.
    EXPECT_LT(part.triangles.size(), 3000u);
    EXPECT_GT(result.sizing.largest_target, 2 * result.sizing.least_target);
}

TEST(Region, EdgesShrinkFromACoarseSeam) {
    const TriangleMesh mesh = shapes::sphere(2);
    const RemeshResult result = expect_manifold_region(
        mesh, upper_half(mesh), {.sizing = {.count = remesh::MeanEdge{0.05}}});
    const TriangleMesh part = new_part(result);
    EXPECT_GT(part.triangles.size(), 1000u);
    EXPECT_GT(least_angle(part), 20);
}

TEST(Region, NumbersOfFacesCountInTheRegion) {
    const TriangleMesh mesh = shapes::sphere(4);
    const RemeshResult result = expect_manifold_region(
        mesh, upper_half(mesh), {.sizing = {.count = remesh::NumFaces{1000}}});
    EXPECT_EQ(new_part(result).triangles.size(), 1000u);
}

TEST(Region, CreasesOfTheRegionStay) {
    const TriangleMesh mesh = parts::box({1, 1, 1}, 16);
    const Mask mask = mask_of(mesh, [](const Vec3& p) { return p.x() > 0.52; });
    const RemeshResult result = expect_manifold_region(mesh, mask, {.num_samples = 500});
    EXPECT_GT(result.features.curves, 0u);
    // No vertex leaves the box, so no crease is cut.
    for (const double x : {0., 1.}) {
        for (const double y : {0., 1.}) {
            for (const double z : {0., 1.}) {
                EXPECT_NE(std::find(result.mesh.positions.begin(), result.mesh.positions.end(),
                                    Vec3(x, y, z)),
                          result.mesh.positions.end());
            }
        }
    }
    EXPECT_NEAR(shapes::signed_volume(result.mesh), 1, 1e-9);
}

TEST(Region, WhatIsGivenForElementsIsCarriedOver) {
    const TriangleMesh mesh = shapes::grid(24);
    const Mask mask = mask_of(mesh, [](const Vec3& p) { return p.x() > 0.3; });
    RemeshOptions options{.num_samples = 900, .features = remesh::Features::Off};
    for (const auto& [a, b, c] : mesh.triangles) {
        const double y = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]).y() / 3;
        options.face_labels.push_back(y > 0.5 ? 1 : 0);
    }
    remesh::VertexLengths lengths;
    for (const Vec3& p : mesh.positions) lengths.values.push_back(0.02 + 0.06 * p.y());
    options.sizing.edges = lengths;
    const RemeshResult result = expect_manifold_region(mesh, mask, options);
    // The border is a chain of edges: no face lies on both sides.
    for (const auto& [a, b, c] : new_part(result).triangles) {
        const auto& p = result.mesh.positions;
        const auto [low, high] = std::minmax({p[a].y(), p[b].y(), p[c].y()});
        EXPECT_FALSE(low < 0.5 - 1e-9 && high > 0.5 + 1e-9);
    }
    int num_low = 0, num_high = 0;
    for (const Vec3& p : result.mesh.positions) ++(p.y() < 0.5 ? num_low : num_high);
    EXPECT_GT(num_low, 1.5 * num_high);
    // Edges of the other part are no mistake, other pairs are.
    options.face_labels.clear();
    options.feature_edges = {{25, 26}};
    expect_manifold_region(mesh, mask, options);
    options.feature_edges = {{0, 100}};
    options.region = mask;
    EXPECT_THROW((void)remesh::remesh(mesh.view(), options), agvd::InvalidInput);
}

TEST(Region, MeshesThatAreNotWeldedHaveASeamToo) {
    const TriangleMesh mesh = shapes::unweld(shapes::sphere(3));
    const RemeshResult result = expect_region(mesh, upper_half(mesh), {.num_samples = 300});
    EXPECT_GT(result.kept.rim_edges, 30u);
    EXPECT_EQ(num_vertices_of(new_part(result)), 300u);
    // Each vertex of the seam is one of those that stay.
    std::set<Bits> positions;
    for (const Index v : result.kept.vertices) positions.insert(bits_of(mesh.positions[v]));
    for (Index v = static_cast<Index>(result.kept.vertices.size());
         v < result.mesh.positions.size(); ++v) {
        EXPECT_FALSE(positions.contains(bits_of(result.mesh.positions[v])));
    }
}

TEST(Region, FacesWithoutAreaBesideTheSeamStay) {
    const TriangleMesh mesh = shapes::filled_slit(5);
    Mask mask = mask_of(mesh, [](const Vec3& p) { return p.y() > 0.1; });
    const auto num_upper = std::count(mask.begin(), mask.end(), 1);
    for (Index f = 0; f < mask.size(); ++f) {
        const auto& [a, b, c] = mesh.triangles[f];
        const auto& p = mesh.positions;
        if ((p[b] - p[a]).cross(p[c] - p[a]).norm() == 0) mask[f] = 1;
    }
    ASSERT_EQ(std::count(mask.begin(), mask.end(), 1), num_upper + 4);
    RemeshOptions options{.num_samples = 60, .region = mask};
    const RemeshResult result = remesh::remesh(mesh.view(), options);
    EXPECT_EQ(result.kept.faces.size(),
              mesh.triangles.size() - static_cast<std::size_t>(num_upper));
    const remesh::Topology topology = remesh::analyze_topology(result.mesh.view());
    EXPECT_TRUE(topology.is_manifold);
    EXPECT_TRUE(remesh::same_topology(topology, remesh::analyze_topology(mesh.view())));
}

// Faces without area on edges of random regions: inside they are absorbed, and at a rim whose edges
// are their short ones. Those at a rim whose edge is the long one stay: a vertex lies on it.
TEST(Region, FacesWithoutAreaAreAbsorbedWhereTheRimPermits) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        SCOPED_TRACE(seed);
        TriangleMesh mesh = parts::box({1, 1, 1}, 4);
        Mask mask = random_mask(mesh, 0.7, seed);
        std::vector<bool> is_used(mesh.positions.size(), false);
        Index num_absorbed = 0;
        const auto num_faces = static_cast<Index>(mesh.triangles.size());
        for (Index f = 0; f < num_faces; ++f) {
            const auto [a, b, c] = mesh.triangles[f];
            if (is_used[a] || is_used[b] || is_used[c]) continue;
            is_used[a] = is_used[b] = is_used[c] = true;
            const auto is_across = [&, u = a, v = b](const Triangle& t) {
                return (t[0] == v && t[1] == u) || (t[1] == v && t[2] == u) ||
                       (t[2] == v && t[0] == u);
            };
            const auto across = static_cast<std::size_t>(
                std::find_if(mesh.triangles.begin(), mesh.triangles.end(), is_across) -
                mesh.triangles.begin());
            const auto middle = static_cast<Index>(mesh.positions.size());
            mesh.positions.emplace_back((mesh.positions[a] + mesh.positions[b]) / 2);
            mesh.triangles[f] = {a, middle, c};
            mesh.triangles.push_back({middle, b, c});
            mesh.triangles.push_back({a, b, middle});
            mask.push_back(mask[f]);
            mask.push_back(mask[across]);  // At the rim of its own part it would stay.
            num_absorbed += mask[across];
        }
        ASSERT_GT(num_absorbed, 5u);
        const RemeshResult result = expect_manifold_region(mesh, mask, {.num_samples = 300});
        const TriangleMesh part = new_part(result);
        EXPECT_EQ(result.cleaned.absorbed_faces, num_absorbed);
        EXPECT_EQ(remesh::measure_triangles(part.view()).faces_without_area, 0u);
        EXPECT_EQ(result.new_self_intersections, 0u);
    }
}

TEST(Region, EdgesWithMoreThanTwoFacesKeepTheirFaces) {
    int num_tried = 0;
    for (const shapes::JunctionShape& shape : shapes::straight_junctions()) {
        for (const std::uint64_t seed : {1u, 2u, 3u}) {
            SCOPED_TRACE(shape.name);
            const Mask mask = seed == 1 ? half_of(shape.mesh) : random_mask(shape.mesh, 0.5, seed);
            expect_region(shape.mesh, mask, {.sizing = {.count = remesh::MeanEdge{0.3}}});
            ++num_tried;
        }
    }
    EXPECT_GE(num_tried, 18);
}

TEST(Region, AnyNumberOfThreadsGivesTheSameBytes) {
    const TriangleMesh mesh = shapes::torus(60, 30);
    RemeshOptions options{.num_samples = 700, .region = half_of(mesh), .num_threads = 1};
    const RemeshResult one = remesh::remesh(mesh.view(), options);
    for (const int threads : {2, 8}) {
        options.num_threads = threads;
        const RemeshResult more = remesh::remesh(mesh.view(), options);
        EXPECT_EQ(more.mesh.positions, one.mesh.positions);
        EXPECT_EQ(more.mesh.triangles, one.mesh.triangles);
    }
}

TEST(Region, IntersectionsWithFacesThatStayCount) {
    // The region has a plane through it that stays.
    const TriangleMesh plane = shapes::moved(shapes::grid(2), {-0.5, -0.5, 0.1});
    const TriangleMesh mesh = shapes::join(shapes::sphere(2), plane);
    Mask mask(mesh.triangles.size(), 0);
    std::fill_n(mask.begin(), mesh.triangles.size() - plane.triangles.size(), 1);
    const RemeshResult result = expect_region(mesh, mask, {.num_samples = 100});
    if (!result.self_intersections) GTEST_SKIP() << "without CGAL";
    EXPECT_EQ(*result.self_intersections, 0u);  // The plane ends inside the sphere.
    const TriangleMesh wide = shapes::moved(shapes::grid(1), {-0.5, -0.5, 0.95});
    const TriangleMesh pierced = shapes::join(shapes::sphere(2), wide);
    mask.assign(pierced.triangles.size(), 0);
    std::fill_n(mask.begin(), pierced.triangles.size() - wide.triangles.size(), 1);
    const RemeshResult crossed = expect_region(pierced, mask, {.num_samples = 100});
    EXPECT_GT(*crossed.self_intersections, 0u);
    EXPECT_GT(crossed.input_self_intersections, 0u);
    EXPECT_EQ(crossed.new_self_intersections +
                  std::min(*crossed.self_intersections, crossed.input_self_intersections),
              *crossed.self_intersections);
}

class RegionOfRealMesh : public testing::TestWithParam<const char*> {};

// The ring around the top of a box: strips of which each long side is one edge that stays.
TEST(Region, ABevelRingIsNotFolded) {
    TriangleMesh box;
    for (const auto& [inset, z] : {std::pair{0., 0.}, {0., 18.}, {2., 20.}}) {
        for (const auto& [x, y] : {std::pair{inset, inset},
                                   {100 - inset, inset},
                                   {100 - inset, 60 - inset},
                                   {inset, 60 - inset}}) {
            box.positions.emplace_back(x, y, z);
        }
    }
    box.triangles = {{0, 2, 1}, {0, 3, 2}, {8, 9, 10}, {8, 10, 11}};
    for (Index row = 0; row < 8; row += 4) {
        for (Index k = 0; k < 4; ++k) {
            const Index a = row + k, b = row + (k + 1) % 4;
            box.triangles.push_back({a, b, b + 4});
            box.triangles.push_back({a, b + 4, a + 4});
        }
    }
    const Mask ring = mask_of(box, [](const Vec3& p) { return p.z() > 18 && p.z() < 20; });
    for (const auto& [n, relax_steps] :
         {std::pair{20u, 60}, {100u, 60}, {400u, 60}, {400u, 0}, {1000u, 60}}) {
        SCOPED_TRACE(n);
        const RemeshResult result = remesh::remesh(
            box.view(),
            {.num_samples = n, .region = ring, .relax_steps = relax_steps, .num_threads = 1});
        EXPECT_EQ(result.self_intersections.value_or(0), 0u);
        double area = 0;
        for (auto f = static_cast<Index>(result.kept.faces.size());
             f < result.mesh.triangles.size(); ++f) {
            const Vec3 normal =
                agvd::doubled_normal(result.mesh.positions, result.mesh.triangles[f]);
            EXPECT_GT(normal.z(), 0);
            area += normal.norm() / 2;
        }
        EXPECT_NEAR(area, 2 * std::numbers::sqrt2 * 2 * (98 + 58), 1e-6);
        if (n < 1000) continue;
        // Faces at the long edges are narrow, but no others are made so.
        EXPECT_LT(remesh::measure_triangles(new_part(result).view()).small_angle_share, 0.4);
    }
}

TEST_P(RegionOfRealMesh, HalfIsRemeshed) {
    const std::filesystem::path path = files::find_mesh(GetParam());
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << path << " is absent; set AGVD_MESHES to the folder that has it";
    }
    const TriangleMesh mesh = remesh::read_mesh(path).mesh;
    const RemeshResult result = expect_manifold_region(mesh, half_of(mesh), {.num_samples = 3000});
    const TriangleMesh part = new_part(result);
    EXPECT_EQ(num_vertices_of(part), 3000u);
    EXPECT_GT(remesh::measure_triangles(part.view()).mean_quality, 0.8);
}

INSTANTIATE_TEST_SUITE_P(Meshes, RegionOfRealMesh,
                         testing::Values("bunny.off", "fandisk.off", "armadillo.obj",
                                         "nefertiti.obj"),
                         [](const auto& test) {
                             const std::string name = test.param;
                             return name.substr(0, name.find('.'));
                         });
