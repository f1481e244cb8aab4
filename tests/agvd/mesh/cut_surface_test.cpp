#include "agvd/mesh/cut_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "agvd/core/error.h"
#include "agvd/diagram/diagram.h"
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
