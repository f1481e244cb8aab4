// The complex without positions is that of the diagram.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"
#include "support/dice.h"
#include "support/line_sites.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// By edge of the surface: how often its label changes, by the points of the curves.
std::vector<Index> changes_on_edges(const Surface& surface, const Diagram& diagram) {
    std::vector<Index> twice(surface.num_edges(), 0);
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const bool is_boundary = !diagram.edges[e].right.is_valid();
        for (Index i = diagram.edge_points[e]; i < diagram.edge_points[e + 1]; ++i) {
            const Passage& passage = diagram.passages[i];
            if (passage.side == Passage::none || (is_boundary && passage.leaves)) continue;
            // On the boundary a change is a point of two curves.
            const Index edge = surface.edge[3 * diagram.points[i].face.value() + passage.side];
            twice[edge] += is_boundary ? 1 : 2;
        }
    }
    for (Index& count : twice) count /= 2;
    return twice;
}

// Beginning with the lowest, which may be anywhere.
std::array<Index, 3> from_lowest(const std::array<SiteId, 3>& around) {
    std::array<Index, 3> sites{around[0].value(), around[1].value(), around[2].value()};
    std::rotate(sites.begin(), std::min_element(sites.begin(), sites.end()), sites.end());
    return sites;
}

CellComplex expect_that_of_the_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                                       PropagationOptions options) {
    options.num_threads = 1;
    const Propagation propagation = propagate(surface, sites, options);
    const Diagram diagram = build_diagram(surface, sites, propagation, {.num_threads = 1});
    CellComplex complex = build_cell_complex(surface, sites, propagation, {.num_threads = 1});
    EXPECT_EQ(complex.num_sites, diagram.num_sites);
    std::vector<std::array<Index, 3>> expected, vertex_sites;
    std::vector<FaceId> vertex_face;
    for (Index v = 0; v < diagram.vertices.size(); ++v) {
        const Index first = diagram.vertex_offsets[v];
        const std::array around{diagram.vertex_sites[first], diagram.vertex_sites[first + 1],
                                diagram.vertex_sites[first + 2]};
        const bool is_on_boundary =
            std::any_of(around.begin(), around.end(), [](SiteId s) { return !s.is_valid(); });
        if (is_on_boundary) continue;
        expected.push_back(from_lowest(around));
        vertex_face.push_back(diagram.vertices[v].face);
    }
    for (const auto& around : complex.vertex_sites) vertex_sites.push_back(from_lowest(around));
    EXPECT_EQ(vertex_sites, expected);
    EXPECT_EQ(complex.vertex_face, vertex_face);
    EXPECT_EQ(complex.nearest_site, diagram.nearest_site);
    EXPECT_EQ(complex.cell_euler, diagram.cell_euler);
    for (Index s = 0; s < diagram.num_sites; ++s) {
        if (diagram.cell_area[s] > 0) {
            EXPECT_EQ(complex.has_cell[s], 1) << "site " << s;
        }
    }
    const std::vector<Index> changes = changes_on_edges(surface, diagram);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        const bool differ =
            diagram.nearest_site[surface.tail(h)] != diagram.nearest_site[surface.head(h)];
        EXPECT_EQ(complex.has_hidden_change[e] != 0, changes[e] > (differ ? 1 : 0)) << "edge " << e;
    }
    return complex;
}

const std::vector<PropagationOptions>& engines() {
    static const std::vector<PropagationOptions> all{
        {.engine = Engine::Window, .max_error = 0.0},
        {.engine = Engine::Window, .max_error = 1e-4},
        {.engine = Engine::Window, .max_error = 1e-2},
        {.engine = Engine::Steiner, .steiner_points = 0},
        {.engine = Engine::Steiner, .steiner_points = 3}};
    return all;
}

}  // namespace

TEST(CellComplex, IsThatOfTheDiagram) {
    const std::pair<const char*, TriangleMesh> meshes[] = {
        {"sphere", shapes::jitter(shapes::sphere(4), 0.01, 3)},
        {"torus", shapes::torus(24, 12)},
        {"grid", shapes::grid(12)},
        {"tube", shapes::jitter(shapes::tube(16, 8), 0.02, 5)},
        {"lips", shapes::lips(12, 6, 3)},
        {"two", shapes::join(shapes::sphere(2), shapes::grid(5))}};
    for (const auto& [name, mesh] : meshes) {
        const Surface surface = build_surface(mesh.view());
        for (const Index t : {1u, 2u, 30u, 300u}) {
            const auto sites = points::scattered(surface, t, 7 + t);
            for (const PropagationOptions& options : engines()) {
                SCOPED_TRACE(std::string(name) + " t=" + std::to_string(t) + " " +
                             engine_name(options.engine) +
                             " E=" + std::to_string(options.max_error.value_or(-1)));
                expect_that_of_the_diagram(surface, sites, options);
            }
        }
    }
}

TEST(CellComplex, IsThatOfTheDiagramOnMeshesThatAreHardForGeodesics) {
    for (const char* family : random_meshes::families()) {
        for (std::uint64_t seed = 0; seed < 25; ++seed) {
            const Surface surface = build_surface(random_meshes::make(family, seed).view());
            Dice dice(seed);
            const auto sites = points::random_sites(dice, surface.num_faces());
            for (const PropagationOptions& options : engines()) {
                SCOPED_TRACE(std::string(family) + " " + std::to_string(seed) + " " +
                             engine_name(options.engine) +
                             " E=" + std::to_string(options.max_error.value_or(-1)));
                expect_that_of_the_diagram(surface, sites, options);
            }
        }
    }
}

TEST(CellComplex, KnowsGroupsStartsAndShapes) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(3), 0.05, 3).view());
    const auto sites = points::scattered(surface, 60, 4);
    for (const PropagationOptions& options : line_sites::kinds_of_sites(surface)) {
        expect_that_of_the_diagram(surface, sites, options);
    }
}

TEST(CellComplex, KnowsSitesOnEdges) {
    const Surface surface = build_surface(shapes::grid(12).view());
    std::vector<SurfacePoint> sites;
    for (Index face = 0; face < surface.num_faces(); face += 17) {
        sites.push_back({FaceId(face), {0.3, 0.7, 0}});
    }
    expect_that_of_the_diagram(surface, sites, {});
}

// Two sites on a strip that a third one crosses: its label lies between theirs on the long edge.
TEST(CellComplex, TellsWhereLabelsChangeMoreOftenThanTheEndsTell) {
    const std::vector<Vec3> positions{{0, 0, 0}, {4, 0, 0}, {2, 1, 0}, {2, -1, 0}};
    const std::vector<Triangle> triangles{{0, 1, 2}, {1, 0, 3}};
    const Surface surface = build_surface(TriangleMesh{positions, triangles}.view());
    const std::vector<SurfacePoint> sites{
        point_at(surface, 0), point_at(surface, 1), {FaceId(0), {0.5, 0.5, 0}}};
    const CellComplex complex = expect_that_of_the_diagram(surface, sites, {});
    const Index long_edge = surface.edge[0];
    for (Index e = 0; e < surface.num_edges(); ++e) {
        EXPECT_EQ(complex.has_hidden_change[e], e == long_edge ? 1 : 0) << "edge " << e;
    }
    EXPECT_EQ(complex.cell_euler, (std::vector<int>{1, 1, 1}));
    EXPECT_EQ(complex.has_cell, (std::vector<std::uint8_t>{1, 1, 1}));
}

TEST(CellComplex, IsTheSameForAnyNumberOfThreads) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(5), 0.002, 3).view());
    const auto sites = points::scattered(surface, 600, 4);
    const Propagation propagation = propagate(surface, sites, {});
    const CellComplex one = build_cell_complex(surface, sites, propagation, {.num_threads = 1});
    const CellComplex eight = build_cell_complex(surface, sites, propagation, {.num_threads = 8});
    EXPECT_EQ(one.vertex_sites, eight.vertex_sites);
    EXPECT_EQ(one.vertex_face, eight.vertex_face);
    EXPECT_EQ(one.cell_euler, eight.cell_euler);
    EXPECT_EQ(one.has_hidden_change, eight.has_hidden_change);
    // Three arcs at each Voronoi vertex of a sphere; some sites may share a place.
    const auto num_cells =
        std::accumulate(one.has_cell.begin(), one.has_cell.end(), std::size_t{0});
    EXPECT_EQ(one.vertex_sites.size(), 2 * num_cells - 4);
    EXPECT_GT(num_cells, 590);
}
