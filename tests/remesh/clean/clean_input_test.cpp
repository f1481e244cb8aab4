#include "remesh/clean/clean_input.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "agvd/core/error.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/topology.h"
#include "support/dirty_shapes.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::analyze_topology;
using remesh::clean_input;
using remesh::CleanCounts;
using remesh::CleanResult;

namespace {

void expect_unchanged(const TriangleMesh& mesh) {
    const CleanResult clean = clean_input(mesh.view());
    EXPECT_EQ(clean.mesh.positions, mesh.positions);
    EXPECT_EQ(clean.mesh.triangles, mesh.triangles);
    std::vector<Index> same(mesh.positions.size());
    std::iota(same.begin(), same.end(), Index{0});
    EXPECT_EQ(clean.vertex_origin, same);
    same.resize(mesh.triangles.size());
    std::iota(same.begin(), same.end(), Index{0});
    EXPECT_EQ(clean.face_origin, same);
    EXPECT_EQ(clean.counts, CleanCounts{});
}

// What build_surface accepts, with the topology of `model`.
CleanResult clean_to(const TriangleMesh& mesh, const TriangleMesh& model) {
    CleanResult clean = clean_input(mesh.view());
    EXPECT_NO_THROW((void)agvd::build_surface(clean.mesh.view()));
    EXPECT_TRUE(same_topology(analyze_topology(clean.mesh.view()), analyze_topology(model.view())));
    return clean;
}

std::string error_of(const TriangleMesh& mesh) {
    try {
        (void)clean_input(mesh.view());
    } catch (const agvd::InvalidInput& error) {
        return error.what();
    }
    return "no error";
}

TriangleMesh turned(TriangleMesh mesh) {
    for (agvd::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

}  // namespace

TEST(CleanInput, LeavesCleanMeshesAsTheyAre) {
    expect_unchanged(shapes::sphere(2));
    expect_unchanged(shapes::grid(5));
    expect_unchanged(shapes::torus(8, 6));
    expect_unchanged(shapes::join(shapes::tube(7, 3), shapes::cube()));
    expect_unchanged(turned(shapes::cube()));
}

TEST(CleanInput, HandsConnectivityOnWhereNothingWasRepaired) {
    for (const TriangleMesh& mesh : {shapes::sphere(2), shapes::tube(9, 4)}) {
        const remesh::CleanResult clean = remesh::clean_input(mesh.view());
        const auto expected = agvd::find_connectivity(mesh.view());
        EXPECT_EQ(clean.connectivity.twin, expected->twin);
        EXPECT_EQ(clean.connectivity.outgoing, expected->outgoing);
        EXPECT_EQ(clean.counts, remesh::CleanCounts());
    }
    TriangleMesh mesh = shapes::sphere(2);
    mesh.positions.emplace_back(9, 9, 9);
    const remesh::CleanResult clean = remesh::clean_input(mesh.view());
    EXPECT_EQ(clean.counts.isolated_vertices, 1u);
    EXPECT_TRUE(clean.connectivity.twin.empty());
}

TEST(CleanInput, DropsOneOfTwoFacesBackToBack) {
    TriangleMesh mesh = shapes::join(shapes::tetrahedron(), shapes::tetrahedron());
    mesh.triangles.resize(4);
    mesh.triangles.push_back({4, 5, 6});
    mesh.triangles.push_back({4, 6, 5});
    mesh.positions.pop_back();
    const remesh::CleanResult clean = remesh::clean_input(mesh.view());
    EXPECT_EQ(clean.counts.duplicate_faces, 1u);
    EXPECT_EQ(clean.mesh.triangles.size(), 5u);
}

TEST(CleanInput, LeavesClosedPartsThatTouchAsTheyAre) {
    TriangleMesh shifted = shapes::cube();
    for (Vec3& p : shifted.positions) p += Vec3(1, 1, 0);
    expect_unchanged(shapes::join(shapes::cube(), shifted));  // Along an edge.
    TriangleMesh grid = shapes::grid(2);
    for (Vec3& p : grid.positions) p += Vec3(1, 1, 0);
    expect_unchanged(shapes::join(shapes::grid(2), grid));  // Open ones, at a point.
}

TEST(CleanInput, WeldsASoupIntoTheSurface) {
    const TriangleMesh model = shapes::torus(9, 7);
    const CleanResult clean = clean_to(shapes::unweld(model), model);
    EXPECT_EQ(clean.mesh.positions.size(), model.positions.size());
    EXPECT_EQ(clean.counts.welded_vertices, 3 * model.triangles.size() - model.positions.size());
    EXPECT_EQ(clean.counts.isolated_vertices, 0u);
    clean_to(shapes::unweld(shapes::grid(4)), shapes::grid(4));
}

TEST(CleanInput, WeldsNegativeZeroToZero) {
    TriangleMesh soup = shapes::unweld(shapes::grid(2));
    for (Index v = 0; v < soup.positions.size(); v += 2) soup.positions[v].z() = -0.0;
    clean_to(soup, shapes::grid(2));
}

// A slit inside the square, and one from its boundary.
TEST(CleanInput, WeldsASlitAndTellsItsLength) {
    for (const auto& [begin, end] : {std::pair<Index, Index>(2, 6), {0, 4}, {5, 8}}) {
        const CleanResult clean = clean_to(shapes::slit_grid(8, begin, end), shapes::grid(8));
        EXPECT_DOUBLE_EQ(clean.slit_length, (end - begin) / 8.0);
    }
    const TriangleMesh two = shapes::join(shapes::slit_grid(8, 2, 4),
                                          shapes::moved(shapes::slit_grid(8, 2, 7), {2, 0, 0}));
    EXPECT_DOUBLE_EQ(clean_input(two.view()).slit_length, 5 / 8.0);
}

// Whether they divide parts, or one part that closes.
TEST(CleanInput, CracksAndSeamsAreNoSlits) {
    EXPECT_EQ(clean_input(shapes::unweld(shapes::grid(4)).view()).slit_length, 0);
    EXPECT_EQ(clean_input(shapes::slit_grid(8, 0, 8).view()).slit_length, 0);
    EXPECT_EQ(clean_input(shapes::grid(4).view()).slit_length, 0);
    // A sphere of degrees of longitude and latitude, whose seam joins the poles.
    TriangleMesh sphere{{{0, 0, 2}, {0, 0, -2}}, {}};
    for (Index i = 0; i <= 8; ++i) {
        const double angle = (i % 8) * std::numbers::pi / 4;
        for (const double z : {1., -1.}) {
            sphere.positions.emplace_back(std::cos(angle), std::sin(angle), z);
        }
    }
    for (Index a = 2; a < 18; a += 2) {
        sphere.triangles.insert(
            sphere.triangles.end(),
            {{0, a, a + 2}, {a, a + 1, a + 2}, {a + 2, a + 1, a + 3}, {1, a + 3, a + 1}});
    }
    const CleanResult closed = clean_to(sphere, shapes::cube());
    EXPECT_EQ(closed.counts.welded_vertices, 2u);
    EXPECT_EQ(closed.slit_length, 0);
}

TEST(CleanInput, LeavesSlitsOpenIfAskedTo) {
    const TriangleMesh mesh = shapes::slit_grid(8, 2, 6);
    const CleanResult clean = clean_input(mesh.view(), {.keep_slits = true});
    EXPECT_EQ(clean.mesh.positions, mesh.positions);
    EXPECT_EQ(clean.mesh.triangles, mesh.triangles);
    EXPECT_EQ(clean.counts, CleanCounts());
    EXPECT_EQ(clean.slit_length, 0);
    // Other defects are mended all the same.
    TriangleMesh dirty = mesh;
    dirty.triangles.push_back(dirty.triangles[0]);
    EXPECT_EQ(clean_input(dirty.view(), {.keep_slits = true}).mesh.triangles, mesh.triangles);
}

TEST(CleanInput, ClosesATextureSeam) {
    // A tube cut along one line, as a texture unwrapping stores it.
    TriangleMesh cut = shapes::tube(8, 3);
    const auto first = static_cast<Index>(cut.positions.size());
    for (Index j = 0; j <= 3; ++j) cut.positions.push_back(Vec3(cut.positions[j]));
    for (std::size_t f = cut.triangles.size() - 6; f < cut.triangles.size(); ++f) {
        for (Index& v : cut.triangles[f]) v = v < 4 ? first + v : v;
    }
    ASSERT_EQ(analyze_topology(cut.view()).boundary_loops(), 1);
    const CleanResult clean = clean_to(cut, shapes::tube(8, 3));
    EXPECT_EQ(clean.counts.welded_vertices, 4u);
}

TEST(CleanInput, DropsDuplicateAndRepeatedCornerFaces) {
    TriangleMesh mesh = shapes::sphere(1);
    const agvd::Triangle first = mesh.triangles[3];
    mesh.triangles.push_back(first);
    mesh.triangles.push_back({first[1], first[0], first[2]});
    mesh.triangles.push_back({first[1], first[0], first[0]});
    const CleanResult clean = clean_input(mesh.view());
    EXPECT_EQ(clean.mesh.triangles, shapes::sphere(1).triangles);
    EXPECT_EQ(clean.counts, (CleanCounts{.degenerate_faces = 1, .duplicate_faces = 2}));
}

TEST(CleanInput, CollapsesZeroLengthEdges) {
    TriangleMesh mesh = shapes::sphere(1);
    mesh.positions[mesh.triangles[0][1]] = Vec3(mesh.positions[mesh.triangles[0][0]]);
    const CleanResult clean = clean_to(mesh, shapes::sphere(1));
    EXPECT_EQ(clean.counts, (CleanCounts{.welded_vertices = 1, .degenerate_faces = 2}));
}

// Surfaces of revolution come with a ring of rounded sines at the pole.
TEST(CleanInput, CollapsesRingsThatAreAsSmallAsRounding) {
    for (const auto& [radius, collapses] : {std::pair{1e-17, true}, {1e-15, false}}) {
        TriangleMesh cone;
        for (const double r : {radius, 1.0}) {
            for (int i = 0; i < 8; ++i) {
                const double angle = i * std::numbers::pi / 4;
                cone.positions.emplace_back(r * std::cos(angle), r * std::sin(angle), r - 1);
            }
        }
        for (Index i = 0; i < 8; ++i) {
            const Index next = (i + 1) % 8;
            cone.triangles.push_back({i, i + 8, next + 8});
            cone.triangles.push_back({i, next + 8, next});
        }
        for (const bool keep_slits : {false, true}) {
            const CleanResult clean = clean_input(cone.view(), {.keep_slits = keep_slits});
            EXPECT_EQ(clean.mesh.triangles.size(), collapses ? 8u : 16u);
            EXPECT_EQ(clean.mesh.positions.size(), collapses ? 9u : 16u);
            EXPECT_EQ(clean.counts,
                      (collapses ? CleanCounts{.welded_vertices = 7, .degenerate_faces = 8}
                                 : CleanCounts{}));
            EXPECT_EQ(clean.welded_positions.empty(), !collapses);
        }
    }
}

TEST(CleanInput, AbsorbsFacesWithoutAreaAndLeavesNoSlit) {
    for (const Index n : {2u, 3u, 40u}) {
        const CleanResult clean = clean_to(shapes::filled_slit(n), shapes::grid(1));
        EXPECT_EQ(clean.counts, (CleanCounts{.absorbed_faces = n - 1})) << n;
        EXPECT_EQ(clean.mesh.triangles.size(), 2 * n + 1) << n;
        for (std::size_t f = 0; f < clean.face_origin.size(); ++f) {
            EXPECT_LT(clean.face_origin[f], n + 2) << "lies in a face that has an area";
        }
    }
}

// The middle edge is whole below and in pieces above: no face has both.
TEST(CleanInput, DividesEdgesOfTheBoundaryAtVerticesThatLieOnThem) {
    for (const Index n : {2u, 3u, 40u}) {
        TriangleMesh mesh = shapes::filled_slit(n);
        mesh.triangles.resize(n + 2);
        const CleanResult clean = clean_to(mesh, shapes::grid(1));
        EXPECT_EQ(clean.counts, (CleanCounts{.divided_edges = n - 1})) << n;
        EXPECT_EQ(clean.mesh.triangles.size(), 2 * n + 1) << n;
        // Both halves with vertices of their own, and a gap that is no rounding.
        TriangleMesh apart = shapes::unweld(mesh);
        for (std::size_t f = 2; f < apart.triangles.size(); ++f) {
            for (const Index v : apart.triangles[f]) apart.positions[v].y() += 0.015;
        }
        EXPECT_EQ(clean_input(apart.view()).counts.divided_edges, 0u);
        EXPECT_EQ(clean_input(apart.view()).loose_vertices, n > 10 ? n - 1 : 0);
        const CleanResult welded = clean_input(apart.view(), {.weld = 0.02});
        EXPECT_EQ(welded.counts.divided_edges, n - 1);
        EXPECT_TRUE(same_topology(analyze_topology(welded.mesh.view()),
                                  analyze_topology(shapes::grid(1).view())));
        EXPECT_EQ(clean_input(mesh.view(), {.keep_slits = true}).counts.divided_edges, 0u);
    }
}

TEST(CleanInput, DividesAllSidesOfAFace) {
    // Around a triangle three others, each of two pieces along it.
    TriangleMesh mesh{{{0, 0, 0},
                       {2, 0, 0},
                       {0, 2, 0},
                       {1, 0, 0},
                       {1, 1, 0},
                       {0, 1, 0},
                       {1, -1, 0},
                       {2, 2, 0},
                       {-1, 1, 0}},
                      {{0, 1, 2}}};
    for (Index k = 0; k < 3; ++k) {
        mesh.triangles.push_back({3 + k, k, 6 + k});
        mesh.triangles.push_back({(k + 1) % 3, 3 + k, 6 + k});
    }
    const CleanResult clean = clean_to(mesh, shapes::grid(1));
    EXPECT_EQ(clean.counts, (CleanCounts{.divided_edges = 3}));
    EXPECT_EQ(clean.mesh.triangles.size(), 10u);
}

// A vertex near an edge of another part, which has no edge there.
TEST(CleanInput, LeavesEdgesWholeThatOnlyTouchAVertex) {
    TriangleMesh mesh{{{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {1, 0, 0}, {0, -1, 0}, {2, -1, 0}},
                      {{0, 1, 2}, {3, 4, 5}}};
    expect_unchanged(mesh);
}

TEST(CleanInput, DropsSliversThatHangOnTheEdgesOfABody) {
    const TriangleMesh body = shapes::subdivide(shapes::cube());
    TriangleMesh mesh = body;
    // Beside the middle of an edge, by a share of its length: rounding, a bow, and a fin.
    const auto with_sliver = [&](double height) {
        mesh = body;
        for (const Index f : {0u, 7u, 30u}) {
            const auto& [a, b, c] = body.triangles[f];
            const Vec3 &p = mesh.positions[a], &q = mesh.positions[b];
            const Vec3 middle = (p + q) / 2 + height * (p - q).norm() * Vec3(0.6, 0.64, 0.48);
            mesh.triangles.push_back({b, a, static_cast<Index>(mesh.positions.size())});
            mesh.positions.push_back(middle);
        }
        return clean_input(mesh.view());
    };
    for (const double height : {0.0, 1e-8, 5e-3}) {
        const CleanResult clean = with_sliver(height);
        EXPECT_EQ(clean.mesh.triangles, body.triangles);
        EXPECT_EQ(clean.counts, (CleanCounts{.degenerate_faces = 3, .isolated_vertices = 3}));
    }
    EXPECT_EQ(with_sliver(0.1).counts.degenerate_faces, 0u);
}

TEST(CleanInput, DropsDegenerateFacesOnTheBoundary) {
    TriangleMesh mesh = shapes::grid(2);
    mesh.triangles.push_back({0, 6, 3});  // 0, 3 and 6 lie on the side y = 0.
    const CleanResult clean = clean_input(mesh.view());
    EXPECT_EQ(clean.mesh.triangles, shapes::grid(2).triangles);
    EXPECT_EQ(clean.counts, CleanCounts{.degenerate_faces = 1});
}

TEST(CleanInput, TurnsTheMinority) {
    for (const TriangleMesh& model : {shapes::grid(4), shapes::sphere(1), turned(shapes::cube())}) {
        TriangleMesh mesh = model;
        std::swap(mesh.triangles[0][1], mesh.triangles[0][2]);
        std::swap(mesh.triangles[5][1], mesh.triangles[5][2]);
        const CleanResult clean = clean_input(mesh.view());
        EXPECT_EQ(clean.mesh.triangles, model.triangles);
        EXPECT_EQ(clean.counts, CleanCounts{.flipped_faces = 2});
    }
}

TEST(CleanInput, TurnsClosedPiecesOutwardWhereThereIsNoMajority) {
    for (const Index first : {0u, 1u}) {
        TriangleMesh mesh = shapes::sphere(2);
        for (Index f = first; f < mesh.triangles.size(); f += 2) {
            std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
        }
        EXPECT_GT(shapes::signed_volume(clean_input(mesh.view()).mesh), 4);
    }
}

TEST(CleanInput, RefusesAOneSidedSurfaceAndNamesAFace) {
    const std::string text = error_of(shapes::moebius(9));
    EXPECT_NE(text.find("not orientable"), std::string::npos) << text;
    EXPECT_NE(text.find("face "), std::string::npos) << text;
    EXPECT_NE(error_of(shapes::unweld(shapes::moebius(9))).find("not orientable"),
              std::string::npos);
}

TEST(CleanInput, CutsAnHourglassAtItsWaist) {
    const CleanResult clean =
        clean_to(shapes::hourglass(), shapes::join(shapes::tetrahedron(), shapes::tetrahedron()));
    EXPECT_EQ(clean.counts, CleanCounts{.split_vertices = 1});
    ASSERT_EQ(clean.mesh.positions.size(), 8u);
    EXPECT_EQ(clean.vertex_origin.back(), 0u);
    EXPECT_EQ(clean.mesh.positions.back(), clean.mesh.positions.front());
}

TEST(CleanInput, CutsThreePagesOnAnEdge) {
    const CleanResult clean = clean_input(shapes::book(3).view());
    EXPECT_NO_THROW((void)agvd::build_surface(clean.mesh.view()));
    EXPECT_EQ(clean.counts.split_edges, 1u);
    EXPECT_EQ(clean.mesh.triangles.size(), 6u);
}

TEST(CleanInput, KeepsTheFlatSheetWholeWhereAWallStandsOnIt) {
    TriangleMesh mesh = shapes::grid(2);  // A wall over the middle line x = 1/2: vertices 3, 4, 5.
    mesh.positions.emplace_back(0.5, 0, 1);
    mesh.positions.emplace_back(0.5, 0.5, 1);
    mesh.positions.emplace_back(0.5, 1, 1);
    for (const bool is_turned : {false, true}) {
        TriangleMesh with_wall = mesh;
        for (agvd::Triangle t : {agvd::Triangle{3, 4, 9}, {9, 4, 10}, {4, 5, 10}, {10, 5, 11}}) {
            if (is_turned) std::swap(t[1], t[2]);
            with_wall.triangles.push_back(t);
        }
        const CleanResult clean =
            clean_to(with_wall, shapes::join(shapes::grid(1), shapes::grid(1)));
        EXPECT_EQ(clean.counts, (CleanCounts{.split_edges = 2, .split_vertices = 3}));
    }
}

TEST(CleanInput, SeparatesCubesThatShareAnEdge) {
    const TriangleMesh two = shapes::join(shapes::cube(), shapes::cube());
    const CleanResult clean = clean_to(shapes::cubes_on_an_edge(), two);
    EXPECT_EQ(clean.counts,
              (CleanCounts{.split_edges = 1, .split_vertices = 2, .isolated_vertices = 2}));
    clean_to(shapes::unweld(shapes::cubes_on_an_edge()), two);
    clean_to(shapes::subdivide(shapes::cubes_on_an_edge()), two);  // An edge in two pieces.
}

TEST(CleanInput, DropsIsolatedVertices) {
    TriangleMesh mesh = shapes::cube();
    mesh.positions.insert(mesh.positions.begin(), Vec3(7, 7, 7));
    for (agvd::Triangle& t : mesh.triangles) {
        for (Index& v : t) ++v;
    }
    const CleanResult clean = clean_input(mesh.view());
    EXPECT_EQ(clean.mesh.triangles, shapes::cube().triangles);
    EXPECT_EQ(clean.counts, CleanCounts{.isolated_vertices = 1});
    EXPECT_EQ(clean.vertex_origin.front(), 1u);
}

TEST(CleanInput, NamesTheElementThatCannotBeUsed) {
    TriangleMesh mesh = shapes::cube();
    mesh.positions[5].y() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(error_of(mesh).find("vertex 5"), std::string::npos);
    mesh = shapes::cube();
    mesh.triangles[4][1] = 8;
    EXPECT_NE(error_of(mesh).find("face 4 names vertex 8"), std::string::npos);
    mesh.triangles[4][0] = static_cast<agvd::Index>(-1);
    EXPECT_NE(error_of(mesh).find("face 4 names vertex -1"), std::string::npos);
    mesh = shapes::cube();
    for (Vec3& p : mesh.positions) p *= 1e200;
    EXPECT_NE(error_of(mesh).find("scale it to a length between"), std::string::npos);
    mesh = shapes::cube();
    for (Vec3& p : mesh.positions) p.x() += 1e15;
    EXPECT_NE(error_of(mesh).find("move it to the origin"), std::string::npos);
    mesh = shapes::cube();
    for (Vec3& p : mesh.positions) p.x() += 1e12;
    EXPECT_EQ(error_of(mesh), "no error");
}

TEST(CleanInput, RefusesMeshesWithoutArea) {
    EXPECT_NE(error_of({}).find("no face"), std::string::npos);
    EXPECT_NE(error_of({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}).find("no face"),
              std::string::npos);
    EXPECT_NE(error_of({{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}}}).find("no face"), std::string::npos);
}
