#include "remesh/sites/label_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "agvd/propagation/propagate.h"
#include "remesh/dual/build_dual.h"
#include "remesh/sites/sampling.h"
#include "remesh/sites/simplify_merged.h"
#include "remesh/sites/site_dual.h"
#include "remesh/sites/sites.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;
using remesh::PreparedSurface;
using remesh::detail::LabelTriangles;
using remesh::detail::NarrowLabels;
using remesh::detail::triangulate_by_labels;

namespace {

constexpr double not_refined = std::numeric_limits<double>::infinity();

Topology topology_of(const std::vector<Triangle>& triangles, std::size_t num_sites) {
    TriangleMesh mesh{std::vector(num_sites, Vec3(0, 0, 0)), triangles};
    return analyze_topology(mesh.view());
}

// Each triangle from its least corner on, in order.
std::set<Triangle> sorted(const std::vector<Triangle>& triangles) {
    std::set<Triangle> result;
    for (Triangle t : triangles) {
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        result.insert(t);
    }
    return result;
}

struct Case {
    TriangleMesh mesh;
    Index num_sites;
};

}  // namespace

// The labels of random sites, after flips by geodesic lengths, against the exact cells.
TEST(LabelTriangles, FlipsLeadToTheDualOfTheCells) {
    Index num_cases = 0, num_flips = 0;
    for (const auto& [mesh, n] : {Case{shapes::sphere(4), 200},
                                  {shapes::torus(60, 30), 250},
                                  {shapes::tube(60, 40), 200}}) {
        const Surface surface = build_surface(mesh.view());
        const PreparedSurface prepared(surface, not_refined);
        for (const std::uint64_t seed : {1u, 2u}) {
            const std::vector<SurfacePoint> start =
                remesh::sample_sites(surface, {.num_samples = n, .seed = seed});
            const std::vector<SurfacePoint> sites =
                remesh::relax_sites(prepared, start, {.steps = 10}).sites;
            const DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
            const std::vector<Triangle> found =
                triangulate_by_labels(surface, labels, sites).triangles;
            std::vector<Vec3> positions;
            for (const SurfacePoint& s : sites) {
                positions.push_back(position(surface.mesh.view(), s));
            }
            const auto flipped =
                remesh::make_delaunay(surface, sites, positions, found, {.may_fold = true});
            const Diagram diagram = build_diagram(surface, sites, propagate(surface, sites));
            const auto dual = remesh::make_delaunay(surface, sites, positions,
                                                    remesh::build_dual(surface, diagram), {});
            std::vector<Triangle> others;
            std::ranges::set_difference(sorted(flipped.triangles), sorted(dual.triangles),
                                        std::back_inserter(others));
            // Four sites on a circle have two triangulations.
            EXPECT_LE(others.size(), 0.02 * static_cast<double>(n));
            num_flips += flipped.counts.flips;
            ++num_cases;
        }
    }
    EXPECT_EQ(num_cases, 6u);
    EXPECT_GT(num_flips, 10u);
}

// Cells wrap around tubes that are narrower than the spacing.
TEST(LabelTriangles, KeepTheTopologyOfNarrowParts) {
    for (const auto& [mesh, n, is_narrow] : {std::tuple{shapes::torus(240, 24, 0.05), 120U, true},
                                             {shapes::torus(240, 24, 0.05), 160U, true},
                                             {shapes::torus(120, 12, 0.08), 80U, true},
                                             {shapes::torus(60, 30), 200U, false}}) {
        const Surface surface = build_surface(mesh.view());
        const PreparedSurface prepared(surface, not_refined);
        const std::vector<SurfacePoint> sites = remesh::sample_sites(surface, {.num_samples = n});
        const DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
        const LabelTriangles merged = triangulate_by_labels(surface, labels, sites);
        EXPECT_EQ(topology_of(merged.triangles, n).is_manifold, !is_narrow) << n;
        EXPECT_EQ(!merged.narrow.empty(), is_narrow) << n;
        const LabelTriangles found =
            triangulate_by_labels(surface, labels, sites, {}, NarrowLabels::Simplify);
        EXPECT_EQ(found.narrow, merged.narrow) << n;
        EXPECT_EQ(found.num_simplified, is_narrow ? 1u : 0u) << n;
        EXPECT_EQ(found.triangles.size(), 2 * n);  // All sites are vertices.
        const Topology topology = topology_of(found.triangles, n);
        EXPECT_TRUE(topology.is_manifold && topology.is_oriented) << n;
        ASSERT_EQ(topology.components.size(), 1u) << n;
        EXPECT_EQ(topology.components[0].genus, 1) << n;
    }
}

// Where labels cover discs their triangles stay as they are.
TEST(LabelTriangles, OnlyComponentsWithNarrowLabelsChange) {
    const TriangleMesh ball = shapes::moved(shapes::sphere(3), {3, 0, 0});
    const TriangleMesh mesh = shapes::join(ball, shapes::torus(240, 24, 0.05));
    const Surface surface = build_surface(mesh.view());
    const PreparedSurface prepared(surface, not_refined);
    const std::vector<SurfacePoint> sites = remesh::sample_sites(surface, {.num_samples = 200});
    const DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
    const LabelTriangles merged = triangulate_by_labels(surface, labels, sites);
    const LabelTriangles found =
        triangulate_by_labels(surface, labels, sites, {}, NarrowLabels::Simplify);
    EXPECT_EQ(found.num_simplified, 1u);
    const auto on_ball = [&](const std::vector<Triangle>& triangles) {
        std::vector<Triangle> some;
        for (const Triangle& t : triangles) {
            if (position(surface.mesh.view(), sites[t[0]]).x() > 1.5) some.push_back(t);
        }
        return sorted(some);
    };
    EXPECT_GT(on_ball(found.triangles).size(), 50u);
    EXPECT_EQ(on_ball(found.triangles), on_ball(merged.triangles));
}

// A torus needs seven vertices: some triangles are missing.
TEST(LabelTriangles, ComponentsWithTooFewSitesStayOpen) {
    const Surface surface = build_surface(shapes::torus(60, 30).view());
    const PreparedSurface prepared(surface, not_refined);
    const std::vector<SurfacePoint> sites = remesh::sample_sites(surface, {.num_samples = 5});
    const DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
    const LabelTriangles found =
        triangulate_by_labels(surface, labels, sites, {}, NarrowLabels::Simplify);
    EXPECT_FALSE(found.narrow.empty());
    EXPECT_FALSE(found.triangles.empty());
    EXPECT_LT(found.triangles.size(), 10u);
    for (const Triangle& t : found.triangles) EXPECT_LT(*std::ranges::max_element(t), 5u);
}

// Around the tip of a spike edges of the base have equal ends, or come twice.
TEST(LabelTriangles, SurfacesThatAreNoMeshAreSimplified) {
    TriangleMesh mesh = shapes::sphere(3);
    for (Index v = 0; v < mesh.positions.size(); v += 5) mesh.positions[v] *= 30;
    const Surface surface = build_surface(mesh.view());
    const PreparedSurface prepared(surface, not_refined);
    const Surface& base = prepared.base.surface();
    ASSERT_FALSE(find_connectivity(base.mesh.view()));
    const std::vector<SurfacePoint> sites = remesh::sample_sites(surface, {.num_samples = 60});
    const DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
    const LabelTriangles found = triangulate_by_labels(
        base, labels, prepared.base.to_intrinsic(sites), {}, NarrowLabels::Simplify);
    EXPECT_EQ(found.num_simplified, 1u);
    EXPECT_EQ(found.triangles.size(), 2u * 60 - 4);
    const Topology topology = topology_of(found.triangles, sites.size());
    EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
    ASSERT_EQ(topology.components.size(), 1u);
    EXPECT_EQ(topology.components[0].euler, 2);
}

// Nothing is left of the merged mesh of a needle whose faces have a corner twice, or pieces are.
TEST(SimplifyMerged, WithoutAConnectedMeshTheSurfaceItselfIsSimplified) {
    const Surface surface = build_surface(shapes::sphere(3).view());
    const std::vector<SurfacePoint> sites = points::scattered(surface, 20, 3);
    const std::vector<Triangle> pieces{{0, 1, 2}, {3, 4, 20}};
    for (const std::span<const Triangle> merged :
         {std::span<const Triangle>(), std::span(pieces)}) {
        std::vector<Triangle> triangles{{5, 6, 7}};
        const std::vector<Index> vertex{11};
        EXPECT_EQ(remesh::detail::simplify_merged(surface, sites, {merged, vertex}, triangles, {}),
                  1u);
        EXPECT_EQ(triangles.size(), 2u * 20 - 4);
        EXPECT_TRUE(topology_of(triangles, 20).is_manifold);
    }
}

// Two sites at one position, so that a merged triangle has no area.
TEST(LabelTriangles, FlatTrianglesAreSimplified) {
    const Surface surface = build_surface(shapes::torus(240, 24, 0.05).view());
    const PreparedSurface prepared(surface, not_refined);
    std::vector<SurfacePoint> sites = remesh::sample_sites(surface, {.num_samples = 120});
    sites.push_back(sites[7]);
    const DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
    const LabelTriangles found =
        triangulate_by_labels(surface, labels, sites, {}, NarrowLabels::Simplify);
    EXPECT_EQ(found.num_simplified, 1u);
    EXPECT_EQ(found.triangles.size(), 2u * 121);
    EXPECT_TRUE(topology_of(found.triangles, sites.size()).is_manifold);
}

// The cells of inner sites wrap around a tube; its rims have every fourth vertex.
// Next to one rim a label covers the boundary between two sites of the rim.
TEST(LabelTriangles, RimsOfNarrowPartsAreTheirChains) {
    TriangleMesh mesh = shapes::tube(24, 120);
    for (Vec3& p : mesh.positions) p = {0.05 * p.x(), 0.05 * p.y(), p.z()};
    const Surface surface = build_surface(mesh.view());
    const PreparedSurface prepared(surface, not_refined);
    std::vector<SurfacePoint> sites;
    std::vector<remesh::DirectedEdge> chain;
    for (const std::vector<Index>& loop : boundary_loops(surface)) {
        const auto first = static_cast<Index>(sites.size());
        for (std::size_t i = 0; i < loop.size(); i += 4) {
            sites.push_back(point_at(surface, surface.tail(loop[i])));
        }
        for (Index i = first; i < sites.size(); ++i) {
            chain.emplace_back(i, i + 1 < sites.size() ? i + 1 : first);
        }
    }
    ASSERT_EQ(sites.size(), 12u);
    for (const Index vertex : {30, 55, 90, 2 * 121 + 1}) {
        sites.push_back(point_at(surface, vertex));
    }
    const DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
    const auto n = static_cast<Index>(sites.size());
    const LabelTriangles merged = triangulate_by_labels(surface, labels, sites, chain);
    EXPECT_EQ(labels.site[2 * 121], 15u);
    EXPECT_EQ(merged.narrow, std::vector<Index>({12, 13, 14}));
    const LabelTriangles found =
        triangulate_by_labels(surface, labels, sites, chain, NarrowLabels::Simplify);
    EXPECT_EQ(found.num_simplified, 1u);
    const Topology topology = topology_of(found.triangles, n);
    EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
    std::ranges::sort(chain);
    EXPECT_EQ(remesh::rim_of(found.triangles), chain);
    EXPECT_EQ(found.triangles.size(), 2 * n - 12);  // Euler's formula.
}

// Of a square, each vertex of which is a site, two corners have one face.
TEST(LabelTriangles, SitesOfCurvesGetTwoTriangles) {
    const Surface surface = build_surface(shapes::grid(4).view());
    const PreparedSurface prepared(surface, not_refined);
    std::vector<SurfacePoint> sites;
    std::vector<remesh::DirectedEdge> chain;
    const std::vector<Index> loop = boundary_loops(surface).front();
    for (Index i = 0; i < loop.size(); ++i) {
        sites.push_back(point_at(surface, surface.tail(loop[i])));
        chain.emplace_back(i, i + 1 < loop.size() ? i + 1 : 0);
    }
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        if (!surface.is_boundary_vertex(v)) sites.push_back(point_at(surface, v));
    }
    ASSERT_EQ(sites.size(), 25u);
    const DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
    const LabelTriangles found = triangulate_by_labels(surface, labels, sites, chain);
    std::vector<Index> count(sites.size(), 0);
    for (const Triangle& t : found.triangles) {
        for (const Index site : t) ++count[site];
    }
    EXPECT_GE(*std::ranges::min_element(count), 2u);
    EXPECT_EQ(found.triangles.size(), 32u);  // Euler's formula.
}

TEST(LabelTriangles, SitesThatLabelNoVertexGetOne) {
    const Surface surface = build_surface(shapes::icosahedron().view());
    const PreparedSurface prepared(surface, not_refined);
    // One site near each vertex, and three more inside of one face.
    std::vector<SurfacePoint> sites;
    for (Index v = 0; v < surface.num_vertices(); ++v) sites.push_back(point_at(surface, v));
    for (const std::array<double, 3>& at :
         {std::array{0.4, 0.3, 0.3}, {0.2, 0.5, 0.3}, {0.25, 0.3, 0.45}}) {
        sites.push_back({FaceId(7), at});
    }
    const DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
    const std::vector<Triangle> found = triangulate_by_labels(surface, labels, sites).triangles;
    EXPECT_EQ(found.size(), 20u + 2 * 3);
    const Topology topology = topology_of(found, sites.size());
    EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
    EXPECT_EQ(topology.components[0].euler, 2);
    // None is turned over: each lies in the part of the face that held it.
    const Vec3 up = surface.mesh.positions[surface.mesh.triangles[7][0]] +
                    surface.mesh.positions[surface.mesh.triangles[7][1]] +
                    surface.mesh.positions[surface.mesh.triangles[7][2]];
    Index num_inside = 0;
    for (const Triangle& t : found) {
        if (std::ranges::all_of(t, [](Index s) { return s < 12; })) continue;
        const auto at = [&](Index k) { return position(surface.mesh.view(), sites[t[k]]); };
        EXPECT_GT((at(1) - at(0)).cross(at(2) - at(0)).dot(up), 0);
        ++num_inside;
    }
    EXPECT_EQ(num_inside, 7u);
}

struct WrongLabels {
    Index before = 0, after = 0;  // The vertices whose label is not the exact one.
};

WrongLabels count_wrong(const TriangleMesh& mesh, Index num_sites, std::uint64_t seed) {
    const Surface surface = build_surface(mesh.view());
    const PreparedSurface prepared(surface, not_refined);
    const std::vector<SurfacePoint> sites = points::scattered(surface, num_sites, seed);
    const DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
    std::vector<Index> corrected = labels.site;
    remesh::detail::correct_labels(
        prepared, sites, triangulate_by_labels(surface, labels, sites).triangles, corrected);
    const Diagram diagram = build_diagram(surface, sites, propagate(surface, sites));
    WrongLabels wrong;
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        const Index exact = diagram.nearest_site[v].value();
        wrong.before += labels.site[v] != exact ? 1 : 0;
        wrong.after += corrected[v] != exact ? 1 : 0;
    }
    return wrong;
}

TEST(LabelTriangles, CorrectedLabelsAreThoseOfTheNearestSites) {
    const WrongLabels wrong = count_wrong(shapes::sphere(4), 300, 5);
    EXPECT_GT(wrong.before, 40u);
    EXPECT_LT(10 * wrong.after, wrong.before);
}

// A plate thinner than the distance of the sites on its two sides: the nearest in space is wrong.
TEST(LabelTriangles, CorrectedLabelsStayOnTheirSide) {
    TriangleMesh plate = shapes::cube();
    for (int i = 0; i < 4; ++i) plate = shapes::subdivide(plate);
    for (Vec3& p : plate.positions) p.z() *= 0.01;
    EXPECT_LT(count_wrong(plate, 100, 2).after, static_cast<Index>(plate.positions.size()) / 25);
}
