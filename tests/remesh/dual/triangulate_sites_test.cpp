#include "remesh/dual/triangulate_sites.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "agvd/propagation/propagate.h"
#include "remesh/sites/sampling.h"
#include "remesh/sites/site_dual.h"
#include "remesh/sites/sites.h"
#include "support/points.h"
#include "support/shapes.h"
#include "support/triangle_set.h"

using namespace agvd;
using remesh::PreparedSurface;
using remesh::detail::Narrow;
using remesh::detail::SiteTriangles;

namespace {

constexpr double not_refined = std::numeric_limits<double>::infinity();

Topology topology_of(const std::vector<Triangle>& triangles, std::size_t num_sites) {
    TriangleMesh mesh{std::vector(num_sites, Vec3(0, 0, 0)), triangles};
    return analyze_topology(mesh.view());
}

SiteTriangles by_labels(const Surface& surface, const DistanceBounds& labels,
                        std::span<const SurfacePoint> sites,
                        std::span<const remesh::DirectedEdge> chain = {},
                        Narrow narrow = Narrow::Leave) {
    return remesh::detail::triangulate_sites(surface, labels, nullptr, sites, chain, narrow);
}

struct ExactCells {
    CellComplex complex;
    DistanceBounds labels;
};

ExactCells cells_of(const Surface& surface, std::span<const SurfacePoint> sites) {
    const Propagation propagation = propagate(surface, sites);
    ExactCells cells{build_cell_complex(surface, sites, propagation), {}};
    cells.labels.distance.assign(propagation.vertex_distance.begin(),
                                 propagation.vertex_distance.end());
    for (const SiteId site : cells.complex.nearest_site) {
        cells.labels.site.push_back(site.is_valid() ? site.value() : no_index);
    }
    return cells;
}

SiteTriangles by_cells(const Surface& surface, const ExactCells& cells,
                       std::span<const SurfacePoint> sites, Narrow narrow = Narrow::Simplify,
                       std::span<const remesh::DirectedEdge> chain = {}) {
    return remesh::detail::triangulate_sites(surface, cells.labels, &cells.complex, sites, chain,
                                             narrow);
}

}  // namespace

// A triangle for each Voronoi vertex.
TEST(TriangulateSites, WhereCellsAreDiscsTheirDualIsTaken) {
    Index num_cases = 0;
    for (const auto& [mesh, n] : {std::pair{shapes::sphere(4), 200U},
                                  {shapes::torus(60, 30), 250U},
                                  {shapes::sphere(3), 300U}}) {
        const Surface surface = build_surface(mesh.view());
        const std::vector<SurfacePoint> sites =
            remesh::sample_sites(surface, {.num_samples = n, .seed = 2});
        const ExactCells cells = cells_of(surface, sites);
        const SiteTriangles found = by_cells(surface, cells, sites);
        std::vector<Triangle> dual;
        for (const auto& [a, b, c] : cells.complex.vertex_sites) {
            dual.push_back({a.value(), b.value(), c.value()});
        }
        EXPECT_EQ(triangle_set(found.triangles), triangle_set(dual));
        EXPECT_EQ(found.triangles.size(), dual.size());
        EXPECT_TRUE(found.narrow.empty());
        EXPECT_EQ(found.counts.sites, n);
        EXPECT_EQ(found.counts.sites_of_cells, n);
        EXPECT_EQ(found.counts.simplified_parts, 0u);
        ++num_cases;
    }
    EXPECT_EQ(num_cases, 3u);
}

// A torus with a thin part: there cells wrap around it. Elsewhere nothing changes.
TEST(TriangulateSites, OnlyTrianglesNearNarrowCellsChange) {
    TriangleMesh mesh = shapes::torus(240, 60, 0.3);
    // Thinner around (1, 0, 0), towards the middle line of the tube.
    for (Vec3& p : mesh.positions) {
        const double length = std::sqrt(p.x() * p.x() + p.y() * p.y());
        const Vec3 middle(p.x() / length, p.y() / length, 0);
        const double share = p.x() > 0.8 ? 0.03 : p.x() < 0.5 ? 1 : 0.03 + 3 * (0.8 - p.x());
        p = middle + share * (p - middle);
    }
    const Surface surface = build_surface(mesh.view());
    for (const Index n : {300U, 600U}) {
        const std::vector<SurfacePoint> sites =
            remesh::sample_sites(surface, {.num_samples = n, .seed = 3});
        const ExactCells cells = cells_of(surface, sites);
        const SiteTriangles left = by_cells(surface, cells, sites, Narrow::Leave);
        const SiteTriangles found = by_cells(surface, cells, sites);
        ASSERT_FALSE(left.narrow.empty());
        EXPECT_EQ(found.narrow, left.narrow);
        EXPECT_TRUE(found.extra.empty());
        EXPECT_EQ(found.counts.narrow_sites, left.narrow.size());
        EXPECT_EQ(found.counts.simplified_patches, 0u);
        EXPECT_GE(found.counts.simplified_parts, 1u);
        EXPECT_EQ(found.triangles.size(), 2 * n);
        const Topology topology = topology_of(found.triangles, n);
        EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
        ASSERT_EQ(topology.components.size(), 1u);
        EXPECT_EQ(topology.components[0].genus, 1);
        std::set<Index> touched;
        const std::set<Triangle> before = triangle_set(left.triangles);
        for (const Triangle& t : triangle_set(found.triangles)) {
            if (!before.contains(t)) touched.insert(t.begin(), t.end());
        }
        EXPECT_EQ(found.counts.sites_of_cells, n - touched.size());
        for (const Index s : touched) {
            EXPECT_GT(position(surface.mesh.view(), sites[s]).x(), 0.3) << s;
        }
    }
}

// Cells wrap around tubes that are narrower than the spacing.
TEST(TriangulateSites, KeepTheTopologyOfNarrowParts) {
    for (const auto& [mesh, n, is_narrow] : {std::tuple{shapes::torus(240, 24, 0.05), 120U, true},
                                             {shapes::torus(240, 24, 0.05), 160U, true},
                                             {shapes::torus(120, 12, 0.08), 80U, true},
                                             {shapes::torus(60, 30), 200U, false}}) {
        const Surface surface = build_surface(mesh.view());
        const PreparedSurface prepared(surface, not_refined);
        const std::vector<SurfacePoint> sites = remesh::sample_sites(surface, {.num_samples = n});
        const DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
        const SiteTriangles merged = by_labels(surface, labels, sites);
        EXPECT_EQ(topology_of(merged.triangles, n).is_manifold, !is_narrow) << n;
        EXPECT_EQ(!merged.narrow.empty(), is_narrow) << n;
        const SiteTriangles found = by_labels(surface, labels, sites, {}, Narrow::Simplify);
        EXPECT_EQ(found.narrow, merged.narrow) << n;
        EXPECT_EQ(found.counts.simplified_parts > 0, is_narrow) << n;
        EXPECT_EQ(found.counts.simplified_patches, 0u) << n;
        EXPECT_EQ(found.triangles.size(), 2 * n);  // All sites are vertices.
        const Topology topology = topology_of(found.triangles, n);
        EXPECT_TRUE(topology.is_manifold && topology.is_oriented) << n;
        ASSERT_EQ(topology.components.size(), 1u) << n;
        EXPECT_EQ(topology.components[0].genus, 1) << n;
    }
}

// Where labels cover discs their triangles stay as they are.
TEST(TriangulateSites, OtherComponentsStayAsTheyAre) {
    const TriangleMesh ball = shapes::moved(shapes::sphere(3), {3, 0, 0});
    const TriangleMesh mesh = shapes::join(ball, shapes::torus(240, 24, 0.05));
    const Surface surface = build_surface(mesh.view());
    const PreparedSurface prepared(surface, not_refined);
    const std::vector<SurfacePoint> sites = remesh::sample_sites(surface, {.num_samples = 200});
    const DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
    const SiteTriangles merged = by_labels(surface, labels, sites);
    const SiteTriangles found = by_labels(surface, labels, sites, {}, Narrow::Simplify);
    EXPECT_EQ(found.counts.simplified_parts, 1u);
    const auto on_ball = [&](const std::vector<Triangle>& triangles) {
        std::vector<Triangle> some;
        for (const Triangle& t : triangles) {
            if (position(surface.mesh.view(), sites[t[0]]).x() > 1.5) some.push_back(t);
        }
        return triangle_set(some);
    };
    EXPECT_GT(on_ball(found.triangles).size(), 50u);
    EXPECT_EQ(on_ball(found.triangles), on_ball(merged.triangles));
}

TEST(TriangulateSites, ComponentsWithoutSitesGetVerticesOfTheirOwn) {
    const TriangleMesh ball = shapes::moved(shapes::sphere(2), {3, 0, 0});
    const Surface surface = build_surface(shapes::join(shapes::sphere(3), ball).view());
    std::vector<SurfacePoint> sites;
    for (const SurfacePoint& s : remesh::sample_sites(surface, {.num_samples = 150})) {
        if (position(surface.mesh.view(), s).x() < 1.5) sites.push_back(s);
    }
    const SiteTriangles found = by_cells(surface, cells_of(surface, sites), sites);
    EXPECT_TRUE(found.narrow.empty());
    EXPECT_GE(found.extra.size(), 4u);
    for (const SurfacePoint& p : found.extra) {
        EXPECT_GT(position(surface.mesh.view(), p).x(), 1.5);
    }
    EXPECT_EQ(found.counts.simplified_patches, 1u);
    EXPECT_EQ(found.counts.sites_of_cells, sites.size());
    const Topology topology = topology_of(found.triangles, sites.size() + found.extra.size());
    EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
    ASSERT_EQ(topology.components.size(), 2u);
    EXPECT_EQ(topology.components[1].euler, 2);
}

// A torus needs seven vertices.
TEST(TriangulateSites, ComponentsWithTooFewSitesGetOtherVerticesAsWell) {
    const Surface surface = build_surface(shapes::torus(60, 30).view());
    const PreparedSurface prepared(surface, not_refined);
    const std::vector<SurfacePoint> sites = remesh::sample_sites(surface, {.num_samples = 5});
    const DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
    const SiteTriangles found = by_labels(surface, labels, sites, {}, Narrow::Simplify);
    EXPECT_FALSE(found.narrow.empty());
    EXPECT_GE(found.extra.size(), 2u);
    const std::size_t num_vertices = sites.size() + found.extra.size();
    EXPECT_EQ(found.triangles.size(), 2 * num_vertices);
    const Topology topology = topology_of(found.triangles, num_vertices);
    EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
    EXPECT_EQ(topology.genus(), 1);
}

// Around the tip of a spike edges of the base have equal ends, or come twice.
TEST(TriangulateSites, SurfacesThatAreNoMeshAreSimplified) {
    TriangleMesh mesh = shapes::sphere(3);
    for (Index v = 0; v < mesh.positions.size(); v += 5) mesh.positions[v] *= 30;
    const Surface surface = build_surface(mesh.view());
    const PreparedSurface prepared(surface, not_refined);
    const Surface& base = prepared.base.surface();
    ASSERT_FALSE(find_connectivity(base.mesh.view()));
    const std::vector<SurfacePoint> sites = remesh::sample_sites(surface, {.num_samples = 60});
    const DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
    const SiteTriangles found =
        by_labels(base, labels, prepared.base.to_intrinsic(sites), {}, Narrow::Simplify);
    EXPECT_EQ(found.counts.simplified_parts, 1u);
    EXPECT_EQ(found.triangles.size(), 2u * 60 - 4);
    const Topology topology = topology_of(found.triangles, sites.size());
    EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
    ASSERT_EQ(topology.components.size(), 1u);
    EXPECT_EQ(topology.components[0].euler, 2);
}

// Two sites at one position, so that a merged triangle has no area.
TEST(TriangulateSites, FlatTrianglesAreSimplified) {
    const Surface surface = build_surface(shapes::torus(240, 24, 0.05).view());
    const PreparedSurface prepared(surface, not_refined);
    std::vector<SurfacePoint> sites = remesh::sample_sites(surface, {.num_samples = 120});
    sites.push_back(sites[7]);
    const DistanceBounds labels = remesh::detail::label_vertices(prepared, sites, 1);
    const SiteTriangles found = by_labels(surface, labels, sites, {}, Narrow::Simplify);
    EXPECT_GE(found.counts.simplified_parts, 1u);
    EXPECT_EQ(found.triangles.size(), 2u * 121);
    EXPECT_TRUE(topology_of(found.triangles, sites.size()).is_manifold);
}

// The cells of inner sites wrap around a tube; its rims have every fourth vertex.
// Next to one rim a label covers the boundary between two sites of the rim.
TEST(TriangulateSites, RimsOfNarrowPartsAreTheirChains) {
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
    const SiteTriangles merged = by_labels(surface, labels, sites, chain);
    EXPECT_EQ(labels.site[2 * 121], 15u);
    EXPECT_EQ(merged.narrow, std::vector<Index>({12, 13, 14}));
    const SiteTriangles found = by_labels(surface, labels, sites, chain, Narrow::Simplify);
    EXPECT_EQ(found.counts.simplified_parts, 1u);
    const Topology topology = topology_of(found.triangles, n);
    EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
    std::ranges::sort(chain);
    EXPECT_EQ(remesh::rim_of(found.triangles), chain);
    EXPECT_EQ(found.triangles.size(), 2 * n - 12);  // Euler's formula.
}

// Of a square, each vertex of which is a site, two corners have one face.
TEST(TriangulateSites, SitesOfCurvesGetTwoTriangles) {
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
    const SiteTriangles found = by_labels(surface, labels, sites, chain);
    std::vector<Index> count(sites.size(), 0);
    for (const Triangle& t : found.triangles) {
        for (const Index site : t) ++count[site];
    }
    EXPECT_GE(*std::ranges::min_element(count), 2u);
    EXPECT_EQ(found.triangles.size(), 32u);  // Euler's formula.
}

TEST(TriangulateSites, SitesThatLabelNoVertexGetOne) {
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
    const std::vector<Triangle> found = by_labels(surface, labels, sites).triangles;
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
