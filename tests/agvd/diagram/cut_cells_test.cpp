#include "agvd/diagram/cut_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/mesh/topology.h"
#include "agvd/propagation/propagate.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// The cells cut from a mesh are manifolds of the surface's topology, have the cells' areas, and lie
// in the faces that they come from.
void expect_cut_along_bisectors(const Surface& surface, const Diagram& diagram) {
    const CutCells cut = cut_cells(surface, diagram);
    ASSERT_EQ(cut.points.size(), cut.mesh.positions.size());
    ASSERT_EQ(cut.face_site.size(), cut.mesh.triangles.size());
    ASSERT_EQ(cut.face_origin.size(), cut.mesh.triangles.size());
    const auto connectivity = find_connectivity(cut.mesh.view());
    ASSERT_TRUE(connectivity);
    const Topology before = analyze_topology(surface.mesh.view());
    const Topology after = analyze_topology(cut.mesh.view());
    EXPECT_TRUE(after.is_manifold && after.is_oriented);
    EXPECT_TRUE(same_topology(before, after));
    std::vector<double> area(diagram.num_sites, 0), of_face(surface.num_faces(), 0);
    double whole = 0;
    for (Index f = 0; f < cut.mesh.triangles.size(); ++f) {
        const Vec3 normal = doubled_normal(cut.mesh.positions, cut.mesh.triangles[f]);
        whole += normal.norm() / 2;
        of_face[cut.face_origin[f]] += normal.norm() / 2;
        if (cut.face_site[f].is_valid()) area[cut.face_site[f].value()] += normal.norm() / 2;
    }
    const double surface_whole = surface_area(surface);
    EXPECT_NEAR(whole, surface_whole, 1e-12 * surface_whole);
    for (Index s = 0; s < diagram.num_sites; ++s) {
        EXPECT_NEAR(area[s], diagram.cell_area[s], 1e-12 * surface_whole) << s;
    }
    for (Index f = 0; f < surface.num_faces(); ++f) {
        EXPECT_NEAR(of_face[f], face_area(surface, f), 1e-12 * surface_whole) << f;
    }
    // No T-junctions: the boundary is as long as before.
    const auto boundary_length = [](const TriangleMesh& mesh, const std::vector<Index>& twin) {
        double length = 0;
        for (Index h = 0; h < twin.size(); ++h) {
            if (twin[h] != no_index) continue;
            length += (mesh.positions[mesh.triangles[h / 3][h % 3]] -
                       mesh.positions[mesh.triangles[h / 3][next_half_edge(h) % 3]])
                          .norm();
        }
        return length;
    };
    const double rim = boundary_length(surface.mesh, surface.twin);
    EXPECT_NEAR(boundary_length(cut.mesh, connectivity->twin), rim, 1e-12 * (1 + rim));
}

void expect_cuts_of(const TriangleMesh& mesh, Index num_sites, double max_length) {
    const Surface surface = build_surface(mesh.view());
    const auto sites = points::scattered(surface, num_sites, 3);
    expect_cut_along_bisectors(surface, build_diagram(surface, sites, propagate(surface, sites)));
    const IntrinsicTriangulation base(
        surface, {.max_length = max_length * std::sqrt(surface_area(surface))});
    const auto on_base = base.to_intrinsic(sites);
    expect_cut_along_bisectors(
        surface, diagram_on_input(base, build_diagram(base.surface(), on_base,
                                                      propagate(base.surface(), on_base))));
}

}  // namespace

TEST(CutCells, HaveTheAreasOfTheirCellsOnShapes) {
    expect_cuts_of(shapes::jitter(shapes::sphere(3), 0.05, 3), 40, 0.1);
    expect_cuts_of(shapes::torus(24, 12), 20, 0.1);
    expect_cuts_of(shapes::cube(), 20, 0.1);
    expect_cuts_of(shapes::jitter(shapes::grid(12), 0.02, 5), 20, 0.1);
    expect_cuts_of(shapes::lips(10, 10, 4), 20, 0.1);
}

TEST(CutCells, HaveTheAreasOfTheirCellsOnRandomMeshes) {
    for (const char* family : random_meshes::families()) {
        for (std::uint64_t seed = 0; seed < 3; ++seed) {
            SCOPED_TRACE(std::string(family) + " seed " + std::to_string(seed));
            expect_cuts_of(random_meshes::make(family, seed), 9, 0.2);
        }
    }
}

// Points of arcs on the input lie beside the chords of the base.
TEST(CutCells, HaveTheAreasOfTheirCellsWithArcs) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(3), 0.05, 3).view());
    const IntrinsicTriangulation base(surface, {.max_length = 0.2});
    const auto on_base = base.to_intrinsic(points::scattered(surface, 40, 3));
    const Propagation propagation = propagate(base.surface(), on_base, {.max_error = 0});
    expect_cut_along_bisectors(
        surface, diagram_on_input(
                     base, build_diagram(base.surface(), on_base, propagation, {.chord = 1e-3})));
}

// A cell inside one face, around which the other site has points: its border reaches no side.
TEST(CutCells, MayBeHolesInAFace) {
    const TriangleMesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}};
    const Surface surface = build_surface(mesh.view());
    std::vector<SurfacePoint> sites;
    for (const auto& [x, y] :
         {std::pair(1.3, 1.3), {1.7, 1.3}, {0.9, 1.3}, {1.3, 1.7}, {1.3, 0.9}}) {
        sites.push_back({FaceId(0), {1 - (x + y) / 4, x / 4, y / 4}});
    }
    const Diagram diagram = build_diagram(
        surface, sites, propagate(surface, sites, {.points = {.site = {0, 1, 1, 1, 1}}}));
    ASSERT_EQ(diagram.edges.size(), 2u);  // The other one is the boundary.
    EXPECT_NEAR(diagram.cell_area[0], 0.16, 1e-12);
    expect_cut_along_bisectors(surface, diagram);
}

TEST(CutCells, WithoutASiteHaveNone) {
    const Surface surface = build_surface(shapes::join(shapes::sphere(1), shapes::grid(2)).view());
    const std::vector<SurfacePoint> sites{point_at(surface, 0)};
    const CutCells cut =
        cut_cells(surface, build_diagram(surface, sites, propagate(surface, sites)));
    EXPECT_EQ(cut.mesh.triangles, surface.mesh.triangles);
    EXPECT_EQ(std::count(cut.face_site.begin(), cut.face_site.end(), SiteId(0)), 80);
    EXPECT_EQ(std::count(cut.face_site.begin(), cut.face_site.end(), SiteId()), 8);
}
