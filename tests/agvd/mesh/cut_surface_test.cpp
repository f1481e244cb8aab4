#include "agvd/mesh/cut_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "agvd/core/error.h"
#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "agvd/propagation/propagate.h"
#include "support/checks.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// Vertices of shapes::grid(40), drawn twice as large: points of [0, 2] x [0, 2].
Index grid_vertex(Index column, Index row) { return 41 * column + row; }

// A slit at y = 1 from x = .2 to x = 1.8.
std::vector<std::uint8_t> slit_of(const Surface& surface) {
    const std::vector<Vec3>& p = surface.mesh.positions;
    std::vector<std::uint8_t> is_cut(surface.num_edges(), 0);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Vec3& a = p[surface.tail(surface.edge_half[e])];
        const Vec3& b = p[surface.head(surface.edge_half[e])];
        const bool lies_along = std::abs(a.y() - 1) < 1e-9 && std::abs(b.y() - 1) < 1e-9;
        const double middle = (a.x() + b.x()) / 2;
        is_cut[e] = lies_along && middle > 0.2 && middle < 1.8 ? 1 : 0;
    }
    return is_cut;
}

TriangleMesh large_grid() {
    TriangleMesh mesh = shapes::grid(40);
    for (Vec3& p : mesh.positions) p *= 2;
    return mesh;
}

}  // namespace

TEST(CutSurface, PathsGoAroundASlit) {
    const Surface whole = build_surface(large_grid().view());
    const OpenedSurface opened = cut_along(whole, slit_of(whole));
    const Surface& surface = opened.surface;
    EXPECT_EQ(surface.num_vertices(), whole.num_vertices() + 31);
    EXPECT_EQ(boundary_loops(surface).size(), 2u);
    const std::vector<SurfacePoint> sites{point_at(surface, grid_vertex(20, 15))};
    const Index target = grid_vertex(20, 25);
    for (const Engine engine : {Engine::Window, Engine::Steiner}) {
        const PropagationOptions options{.engine = engine, .steiner_points = 20};
        const double around = 2 * std::sqrt(0.8 * 0.8 + 0.25 * 0.25);
        EXPECT_NEAR(propagate(surface, sites, options).vertex_distance[target], around,
                    engine == Engine::Window ? 1e-12 : 1e-3);
        EXPECT_NEAR(propagate(whole, sites, options).vertex_distance[target], 0.5, 1e-12);
    }
}

// Sites at y = 1: a vertex, the middle of an edge, a line along the slit, and one that ends there.
TEST(CutSurface, SitesOnACutCountOnAllSides) {
    const Surface whole = build_surface(large_grid().view());
    const Surface opened = cut_along(whole, slit_of(whole)).surface;
    const auto expect_both = [&](SurfaceSites given, double above, double below) {
        const SurfaceSites sites = on_all_sides(whole, opened, std::move(given));
        const Propagation found = propagate(
            opened, sites.points, {.points = sites.roles, .shapes = sites.shapes, .max_error = 0});
        for (const auto& [row, distance] : {std::pair(24, above), std::pair(16, below)}) {
            EXPECT_NEAR(found.vertex_distance[grid_vertex(20, row)], distance, 1e-12);
            EXPECT_EQ(found.vertex_site[grid_vertex(20, row)], SiteId(0));
        }
    };
    const std::vector<Index> middle =
        edges_along(whole, std::array{grid_vertex(20, 20), grid_vertex(21, 20)});
    expect_both({{point_at(opened, grid_vertex(20, 20))}}, 0.2, 0.2);
    expect_both({{point_on(whole.edge_half[middle[0]], 0.5)}, {.start = {0.1}}},
                0.1 + std::hypot(0.2, 0.025), 0.1 + std::hypot(0.2, 0.025));
    const Index of_one_side = opened.edge[whole.edge_half[middle[0]]];
    expect_both({.shapes = {{.edges = {of_one_side}}}}, 0.2, 0.2);
    const auto across = edges_along(
        whole, std::array{grid_vertex(20, 22), grid_vertex(20, 21), grid_vertex(20, 20)});
    const auto on_opened = [&](Index edge) { return opened.edge[whole.edge_half[edge]]; };
    expect_both({.shapes = {{.edges = {on_opened(across[0]), on_opened(across[1])}}}}, 0.1, 0.2);
    const SurfaceSites off{{point_at(opened, grid_vertex(3, 3))}};
    EXPECT_EQ(on_all_sides(whole, opened, off).roles, SitePoints{});
}

TEST(CutSurface, KeepsFacesAndTheNumbersOfFirstCopies) {
    const Surface whole = build_surface(large_grid().view());
    const OpenedSurface opened = cut_along(whole, slit_of(whole), 1);
    ASSERT_EQ(opened.surface.num_faces(), whole.num_faces());
    for (Index f = 0; f < whole.num_faces(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = opened.surface.mesh.triangles[f][k];
            EXPECT_EQ(opened.original[v], whole.mesh.triangles[f][k]);
            EXPECT_EQ(opened.surface.mesh.positions[v], whole.mesh.positions[opened.original[v]]);
        }
    }
    for (Index v = 0; v < whole.num_vertices(); ++v) EXPECT_EQ(opened.original[v], v);
    checks::expect_same(opened.surface, cut_along(whole, slit_of(whole), 3).surface);
    // What is read back has the same connectivity: copies are vertices of their own.
    checks::expect_same(opened.surface, build_surface(opened.surface.mesh.view()));
}

TEST(CutSurface, AClosedCutMakesTwoComponents) {
    const Surface sphere = build_surface(shapes::sphere(2).view());
    std::vector<std::uint8_t> is_cut(sphere.num_edges(), 0);
    for (Index h = 0; h < 3; ++h) is_cut[sphere.edge[h]] = 1;  // Around the first face.
    const Surface surface = cut_along(sphere, is_cut).surface;
    EXPECT_EQ(find_components(surface).size(), 2u);
    EXPECT_EQ(surface.num_vertices(), sphere.num_vertices() + 3);
    const auto sites = points::scattered(sphere, 9, 1);
    const Diagram diagram = build_diagram(surface, sites, propagate(surface, sites));
    checks::expect_valid_complex(surface, diagram);
    EXPECT_THROW((void)cut_along(sphere, std::vector<std::uint8_t>(3)), InvalidOption);
}

TEST(CutSurface, NothingToCutIsTheSame) {
    const Surface sphere = build_surface(shapes::sphere(1).view());
    const std::vector<std::uint8_t> none(sphere.num_edges(), 0);
    checks::expect_same(cut_along(sphere, none).surface, sphere);
}
