// The whole job on meshes whose edges have more than two faces.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "agvd/core/error.h"
#include "agvd/mesh/closest_point.h"
#include "remesh/pipeline/remesh.h"
#include "support/crease_checks.h"
#include "support/dirty_shapes.h"
#include "support/junction_shapes.h"
#include "support/parts.h"
#include "support/shapes.h"

using namespace agvd;
using remesh::Features;
using remesh::Junctions;
using remesh::RemeshOptions;
using remesh::RemeshResult;
using shapes::JunctionShape;

namespace {

// Equal for equal bits.
using Place = std::array<double, 3>;
using PlacedEdge = std::pair<Place, Place>;

Place place_of(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

// Faces at each edge, edges with the same ends being one.
std::map<PlacedEdge, Index> faces_by_place(const TriangleMesh& mesh) {
    std::map<PlacedEdge, Index> count;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Place a = place_of(mesh.positions[t[k]]);
            const Place b = place_of(mesh.positions[t[(k + 1) % 3]]);
            ++count[std::minmax(a, b)];
        }
    }
    return count;
}

// The same, each edge by its vertices.
std::map<std::pair<Index, Index>, Index> faces_by_index(const TriangleMesh& mesh) {
    std::map<std::pair<Index, Index>, Index> count;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) ++count[std::minmax({t[k], t[(k + 1) % 3]})];
    }
    return count;
}

template <typename Counts>
Index num_branched(const Counts& counts) {
    return static_cast<Index>(
        std::count_if(counts.begin(), counts.end(), [](const auto& c) { return c.second > 2; }));
}

// Edges of so many faces make up the lines of the junctions, and no others have more than two.
void expect_lines(const JunctionShape& shape, const TriangleMesh& mesh) {
    double length = 0, wanted = 0;
    for (const auto& [edge, count] : faces_by_place(mesh)) {
        if (count <= 2) continue;
        EXPECT_EQ(count, shape.num_faces);
        const Vec3 a(edge.first.data()), b(edge.second.data());
        length += (b - a).norm();
        const Vec3 middle = (a + b) / 2;
        double nearest = 1;
        for (const auto& [from, to] : shape.lines) {
            nearest = std::min(nearest, distance_to_segment(middle, from, to));
        }
        EXPECT_LT(nearest, 1e-12);
    }
    for (const auto& [from, to] : shape.lines) wanted += (to - from).norm();
    EXPECT_NEAR(length, wanted, 1e-9);
    std::vector<Vec3> ends;
    for (const auto& [from, to] : shape.lines) ends.insert(ends.end(), {from, to});
    EXPECT_LT(crease_checks::farthest_from_vertices(ends, mesh), 1e-12);
}

void expect_apart(const RemeshResult& result, Index num_samples) {
    EXPECT_EQ(result.mesh.positions.size(), num_samples);
    EXPECT_EQ(result.sites.size(), num_samples);
    const remesh::Topology topology = remesh::analyze_topology(result.mesh.view());
    EXPECT_TRUE(topology.is_manifold);
    EXPECT_TRUE(topology.is_oriented);
    EXPECT_TRUE(same_topology(topology, result.input_topology));
}

// A sphere on one edge of which a triangle stands.
TriangleMesh sphere_with_a_fin() {
    TriangleMesh mesh = shapes::sphere(4);
    const auto [a, b, c] = mesh.triangles[100];
    const Vec3 middle = (mesh.positions[a] + mesh.positions[b]) / 2;
    mesh.triangles.push_back({b, a, static_cast<Index>(mesh.positions.size())});
    mesh.positions.emplace_back(1.2 * middle);
    return mesh;
}

RemeshResult run(const TriangleMesh& mesh, const RemeshOptions& options) {
    return remesh::remesh(mesh.view(), options);
}

}  // namespace

TEST(Junctions, AllSheetsHaveTheSamePointsThere) {
    for (const JunctionShape& shape : shapes::straight_junctions()) {
        for (const Index n : {100u, 1000u}) {
            for (const Features features : {Features::Auto, Features::Off}) {
                SCOPED_TRACE(shape.name + ", " + std::to_string(n) + ", " +
                             remesh::features_name(features));
                const RemeshResult result =
                    run(shape.mesh, {.num_samples = n, .features = features});
                expect_apart(result, n);
                expect_lines(shape, result.mesh);
                EXPECT_EQ(result.self_intersections.value_or(0), 0u);
                EXPECT_EQ(result.junctions.edges, shape.num_edges);
                EXPECT_EQ(result.junctions.apart_edges, 0u);
                EXPECT_EQ(result.junctions.welded_edges, 0u);
                EXPECT_GE(result.junctions.curves, shape.lines.size());
            }
        }
    }
}

TEST(Junctions, KeptOnesAreWeldedAndNothingElseIs) {
    for (const JunctionShape& shape : shapes::straight_junctions()) {
        for (const Index n : {100u, 1000u}) {
            SCOPED_TRACE(shape.name + ", " + std::to_string(n));
            const RemeshResult result =
                run(shape.mesh, {.num_samples = n, .junctions = Junctions::Keep});
            EXPECT_EQ(result.mesh.positions.size(), n);
            EXPECT_EQ(result.sites.size(), n);
            expect_lines(shape, result.mesh);
            EXPECT_EQ(faces_by_index(result.mesh).size(), faces_by_place(result.mesh).size());
            EXPECT_EQ(result.junctions.welded_edges, num_branched(faces_by_index(result.mesh)));
            EXPECT_EQ(result.junctions.apart_edges, 0u);
            EXPECT_EQ(result.self_intersections.value_or(0), 0u);
            EXPECT_FALSE(remesh::analyze_topology(result.mesh.view()).is_manifold);
        }
    }
}

TEST(Junctions, VerticesCountOnceForEachSheetUnlessWelded) {
    const JunctionShape shape = shapes::pages(5);
    for (const Junctions junctions : {Junctions::Apart, Junctions::Keep}) {
        const RemeshResult result = run(shape.mesh, {.num_samples = 500, .junctions = junctions});
        std::set<Place> places;
        Index num_there = 0;
        for (const Vec3& p : result.mesh.positions) {
            if (p.x() != 0 || p.y() != 0) continue;
            places.insert(place_of(p));
            ++num_there;
        }
        EXPECT_EQ(num_there, places.size() * (junctions == Junctions::Apart ? 5 : 1));
        EXPECT_EQ(result.junctions.vertices, num_there);
    }
}

TEST(Junctions, AnEdgeAloneIsASlitAndNoReasonToThinTheSurface) {
    const TriangleMesh mesh = sphere_with_a_fin();
    const RemeshResult result = run(mesh, {.num_samples = 20000});
    expect_apart(result, 20000);
    EXPECT_EQ(result.junctions.edges, 1u);
    EXPECT_EQ(result.junctions.apart_edges, 0u);
    EXPECT_EQ(result.junctions.vertices, 8u);
    EXPECT_LE(result.dual.simplified_parts, 1u);  // The triangle that stands off.
}

TEST(Junctions, ShorterOnesThanTwoSpacingsStayApart) {
    const TriangleMesh mesh = sphere_with_a_fin();
    const RemeshResult apart = run(mesh, {.num_samples = 500});
    expect_apart(apart, 500);
    EXPECT_EQ(apart.junctions.edges, 1u);
    EXPECT_EQ(apart.junctions.apart_edges, 1u);
    EXPECT_EQ(apart.junctions.curves, 0u);
    const RemeshResult kept = run(mesh, {.num_samples = 500, .junctions = Junctions::Keep});
    EXPECT_EQ(kept.junctions.apart_edges, 0u);
    EXPECT_EQ(kept.junctions.welded_edges, 2u);
}

TEST(Junctions, EachSheetsSitesLieOnItself) {
    const TriangleMesh mesh = shapes::tee().mesh;
    const RemeshResult result = run(mesh, {.num_samples = 300, .fit = false});
    Index num_on_plate = 0, num_on_wall = 0;
    for (std::size_t v = 0; v < result.sites.size(); ++v) {
        const Vec3& p = result.mesh.positions[v];
        EXPECT_LT((position(mesh.view(), result.sites[v]) - p).norm(), 1e-12);
        if (p.x() != 0 || p.z() != 0) continue;
        const Triangle& t = mesh.triangles[result.sites[v].face.value()];
        const bool is_on_plate = std::all_of(
            t.begin(), t.end(), [&](Index corner) { return mesh.positions[corner].z() == 0; });
        ++(is_on_plate ? num_on_plate : num_on_wall);
    }
    EXPECT_EQ(num_on_plate, num_on_wall);
    EXPECT_EQ(num_on_plate + num_on_wall, result.junctions.vertices);
}

TEST(Junctions, ClosedOnesNeedNoCorner) {
    const TriangleMesh mesh = shapes::round_pipe_on_plate(48);
    const RemeshResult result = run(mesh, {.num_samples = 600});
    expect_apart(result, 600);
    EXPECT_EQ(result.junctions.edges, 48u);
    EXPECT_EQ(result.junctions.curves, 1u);
    const auto counts = faces_by_place(result.mesh);
    EXPECT_EQ(num_branched(counts), result.junctions.vertices / 2);
    for (const auto& [edge, count] : counts) {
        EXPECT_LE(count, 3u);
        if (count < 3) continue;
        // Sheets keep their boundary: vertices lie on the 48 edges.
        double nearest = 1;
        for (int k = 0; k < 48; ++k) {
            const double turn = 2 * std::numbers::pi / 48;
            const Vec3 from(std::cos(k * turn), std::sin(k * turn), 0);
            const Vec3 to(std::cos((k + 1) * turn), std::sin((k + 1) * turn), 0);
            nearest = std::min(nearest, distance_to_segment(Vec3(edge.first.data()), from, to));
        }
        EXPECT_LT(nearest, 1e-12);
    }
}

TEST(Junctions, ASheetThatComesThriceIsCutOpenAndMeetsItself) {
    const TriangleMesh mesh = shapes::twisted_pages(60);
    const RemeshResult apart = run(mesh, {.num_samples = 600});
    expect_apart(apart, 600);
    ASSERT_EQ(apart.input_topology.components.size(), 1u);
    EXPECT_EQ(apart.junctions.apart_edges, 0u);
    EXPECT_EQ(num_branched(faces_by_place(apart.mesh)), apart.junctions.vertices / 3);
    const RemeshResult kept = run(mesh, {.num_samples = 600, .junctions = Junctions::Keep});
    EXPECT_EQ(kept.mesh.positions.size(), 600u);
    EXPECT_EQ(kept.junctions.apart_edges, 0u);
    EXPECT_EQ(kept.junctions.welded_edges, kept.junctions.vertices);
    EXPECT_EQ(num_branched(faces_by_index(kept.mesh)), kept.junctions.welded_edges);
}

TEST(Junctions, SheetsThatChangePartnersAreOneThatMeetsItself) {
    const TriangleMesh mesh = shapes::pages_that_change_partners(8);
    const RemeshResult apart = run(mesh, {.num_samples = 500});
    expect_apart(apart, 500);
    ASSERT_EQ(apart.input_topology.components.size(), 1u);
    EXPECT_EQ(apart.junctions.apart_edges, 0u);
    const RemeshResult kept = run(mesh, {.num_samples = 500, .junctions = Junctions::Keep});
    EXPECT_EQ(kept.mesh.positions.size(), 500u);
    for (const RemeshResult* result : {&apart, &kept}) {
        double length = 0;
        for (const auto& [edge, count] : faces_by_place(result->mesh)) {
            if (count <= 2) continue;
            EXPECT_EQ(count, 4u);
            length += (Vec3(edge.first.data()) - Vec3(edge.second.data())).norm();
        }
        EXPECT_NEAR(length, 2, 1e-12);
    }
}

TEST(Junctions, SheetsThatShareAPointStayApart) {
    const TriangleMesh mesh = shapes::cones_at_a_point(24);
    const RemeshResult apart = run(mesh, {.num_samples = 300});
    const RemeshResult kept = run(mesh, {.num_samples = 300, .junctions = Junctions::Keep});
    expect_apart(apart, 300);
    EXPECT_EQ(apart.input_topology.components.size(), 2u);
    EXPECT_EQ(apart.junctions.edges, 0u);
    EXPECT_EQ(apart.mesh.positions, kept.mesh.positions);
    EXPECT_EQ(apart.mesh.triangles, kept.mesh.triangles);
}

// As in STL files. Cubes fall apart there, as closed parts that touch do.
TEST(Junctions, FacesWithCornersOfTheirOwnHaveThemToo) {
    for (const JunctionShape& shape : {shapes::tee(), shapes::pages(5), shapes::three_planes()}) {
        SCOPED_TRACE(shape.name);
        const RemeshResult result = run(shapes::unweld(shape.mesh), {.num_samples = 300});
        expect_apart(result, 300);
        expect_lines(shape, result.mesh);
        EXPECT_EQ(result.junctions.edges, shape.num_edges);
    }
}

TEST(Junctions, AreKnownByOriginAndNotByPlace) {
    // Two closed cubes, each with vertices of its own, touch in an edge: nothing is shared.
    TriangleMesh cubes = shapes::join(parts::box({1, 1, 1}, 4), parts::box({1, 1, 1}, 4));
    for (std::size_t v = cubes.positions.size() / 2; v < cubes.positions.size(); ++v) {
        cubes.positions[v] += Vec3(1, 1, 0);
    }
    EXPECT_EQ(run(cubes, {.num_samples = 300}).junctions.edges, 0u);
}

TEST(Junctions, ThreadsChangeNothing) {
    for (const JunctionShape& shape : shapes::straight_junctions()) {
        SCOPED_TRACE(shape.name);
        for (const Junctions junctions : {Junctions::Apart, Junctions::Keep}) {
            const RemeshResult one =
                run(shape.mesh, {.num_samples = 200, .junctions = junctions, .num_threads = 1});
            const RemeshResult two =
                run(shape.mesh, {.num_samples = 200, .junctions = junctions, .num_threads = 2});
            EXPECT_EQ(one.mesh.positions, two.mesh.positions);
            EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
        }
    }
}

TEST(Junctions, WhatIsNotPossibleIsToldAndNoFailure) {
    const JunctionShape shape = shapes::three_planes();
    const RemeshResult few = run(shape.mesh, {.num_samples = 20, .junctions = Junctions::Keep});
    expect_apart(few, 20);
    EXPECT_EQ(few.junctions.apart_edges, shape.num_edges);
    EXPECT_GT(few.junctions.samples_for_all, 20u);
    const Index enough = few.junctions.samples_for_all + 50;
    EXPECT_EQ(run(shape.mesh, {.num_samples = enough}).junctions.apart_edges, 0u);
    const RemeshResult free =
        run(shape.mesh, {.num_samples = 300, .boundary = remesh::Boundary::Free});
    expect_apart(free, 300);
    EXPECT_EQ(free.junctions.apart_edges, shape.num_edges);
    const RemeshResult again = run(shape.mesh, {.sites = free.sites});
    EXPECT_EQ(again.junctions.apart_edges, shape.num_edges);
}

// Whatever the soup, there is a result, with the same points or without.
TEST(Junctions, SoupsEndWell) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        SCOPED_TRACE(seed);
        const TriangleMesh soup = shapes::damage(shapes::pages(4).mesh, 40, seed);
        try {
            const RemeshResult result = run(soup, {.num_samples = 300});
            expect_apart(result, 300);
            EXPECT_GT(result.junctions.edges, 0u);
        } catch (const InvalidInput&) {
        }  // A one-sided piece.
    }
}

TEST(FaceLabels, TheirBordersAreCreasesAsGivenEdgesAre) {
    const TriangleMesh mesh = shapes::grid(8);
    RemeshOptions by_labels{.num_samples = 300, .features = Features::Off};
    RemeshOptions by_edges = by_labels;
    const auto side = [&](const Triangle& t) {
        const auto& p = mesh.positions;
        return (p[t[0]] + p[t[1]] + p[t[2]]).x() / 3 < .5 ? 7u : 2u;
    };
    for (const Triangle& t : mesh.triangles) by_labels.face_labels.push_back(side(t));
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            if (mesh.positions[a].x() == .5 && mesh.positions[b].x() == .5) {
                by_edges.feature_edges.push_back({a, b});
            }
        }
    }
    const RemeshResult result = run(mesh, by_labels);
    expect_apart(result, 300);
    EXPECT_EQ(result.features.length, 1);
    EXPECT_EQ(result.mesh.positions, run(mesh, by_edges).mesh.positions);
    for (const Triangle& t : result.mesh.triangles) {
        int left = 0, right = 0;
        for (const Index v : t) {
            left += result.mesh.positions[v].x() < .5 - 1e-9 ? 1 : 0;
            right += result.mesh.positions[v].x() > .5 + 1e-9 ? 1 : 0;
        }
        EXPECT_TRUE(left == 0 || right == 0);
    }
}

TEST(FaceLabels, OneIsNeededForEachFace) {
    const TriangleMesh mesh = shapes::grid(2);
    EXPECT_THROW((void)run(mesh, {.face_labels = {1, 2, 3}}), InvalidOption);
    // Where all are the same there is no border.
    const std::vector<Index> same(mesh.triangles.size(), 4);
    EXPECT_EQ(run(mesh, {.num_samples = 50, .features = Features::Off, .face_labels = same})
                  .features.length,
              0);
}

// Where the vertices are too few for a mesh with all curves.
TEST(Junctions, GoBeforeCreasesWhereSheetsStayApartAndAfterThemWhereTheyAreWelded) {
    const TriangleMesh mesh = shapes::join(
        shapes::pages(5).mesh, shapes::moved(shapes::cubes_with_an_edge().mesh, {5, 0, 0}));
    RemeshOptions options{.num_samples = 28, .num_threads = 1};
    const RemeshResult apart = remesh::remesh(mesh.view(), options);
    EXPECT_EQ(apart.junctions.apart_edges, apart.junctions.edges);
    EXPECT_GT(apart.features.length, 5);
    EXPECT_FALSE(apart.features.gave_up);
    options.junctions = Junctions::Keep;
    options.num_samples = 20;
    const RemeshResult welded = remesh::remesh(mesh.view(), options);
    EXPECT_EQ(welded.junctions.apart_edges, 0u);
    EXPECT_EQ(welded.features.length, 0);
    EXPECT_TRUE(welded.features.gave_up);
}
