// Real parts have their creases found, real scans have next to none.
#include <gtest/gtest.h>

#include <cmath>

#include "agvd/mesh/surface.h"
#include "remesh/clean/clean_input.h"
#include "remesh/curves/crease_chains.h"
#include "remesh/curves/find_creases.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/files.h"
#include "support/parts.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

double diagonal_of(const TriangleMesh& mesh) {
    Vec3 low = mesh.positions[0], high = low;
    for (const Vec3& p : mesh.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
    return (high - low).norm();
}

// Lengths in diagonals.
struct Found {
    double candidates = 0;  // Above 40 degrees.
    double length = 0;
    double of_candidates = 0;
};

Found find(const TriangleMesh& mesh, double diagonal, double sites) {
    const Surface surface = build_surface(mesh.view());
    const double spacing = std::sqrt(surface_area(surface) / sites);
    const auto flags = remesh::find_creases(surface, {.spacing = spacing});
    Poller poller;
    const auto angles = remesh::detail::edge_angles(surface, 1e-3 * spacing, 1, poller);
    Found found;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const double length = surface.length[e] / diagonal;
        if (angles[e] > 40 * degree) found.candidates += length;
        if (flags[e] != 0) found.length += length;
        if (angles[e] > 40 * degree && flags[e] != 0) found.of_candidates += length;
    }
    return found;
}

class RealPart : public testing::TestWithParam<const char*> {};
class RealScan : public testing::TestWithParam<const char*> {};

TriangleMesh cleaned(const std::filesystem::path& path) {
    return remesh::clean_input(remesh::read_mesh(path).mesh.view()).mesh;
}

}  // namespace

TEST_P(RealPart, HasItsCreasesAtEverySpacing) {
    const auto path = files::find_mesh(GetParam());
    if (!exists(path)) GTEST_SKIP() << path << " is absent; set AGVD_MESHES to its folder";
    const TriangleMesh mesh = cleaned(path);
    const double diagonal = diagonal_of(mesh);
    for (const double sites : {200., 2000., 20000.}) {
        const Found found = find(mesh, diagonal, sites);
        EXPECT_GT(found.candidates, 2);
        EXPECT_GT(found.of_candidates, (sites < 2000 ? 0.9 : 0.97) * found.candidates) << sites;
        EXPECT_LT(found.length, 1.06 * found.candidates) << sites;
    }
    // Other triangles, the same creases.
    const double length = find(mesh, diagonal, 2000).length;
    for (const TriangleMesh& other :
         {parts::with_needles(mesh, 0.3, 0.4, 1), parts::with_needles(mesh, 1e-4, 0.4, 1),
          shapes::subdivide(mesh), parts::turned(mesh, 1)}) {
        EXPECT_NEAR(find(other, diagonal, 2000).length, length, 1e-3 * length);
    }
}

INSTANTIATE_TEST_SUITE_P(Creases, RealPart,
                         testing::Values("data/part.off", "fandisk.off", "beetle.off",
                                         "dirty/65004.stl", "dirty/58011.stl", "dirty/79741.stl",
                                         "dirty/72214.stl"));

TEST(Creases, PartOfTheDataFolderHasAllOfThem) {
    const TriangleMesh mesh = cleaned(std::filesystem::path(AGVD_DATA_DIR) / "part.off");
    const Found found = find(mesh, diagonal_of(mesh), 2000);
    EXPECT_GT(found.candidates, 14);
    EXPECT_EQ(found.of_candidates, found.candidates);
    EXPECT_EQ(found.length, found.candidates);
}

TEST_P(RealScan, IsLeftAlone) {
    const auto path = files::find_mesh(GetParam());
    if (!exists(path)) GTEST_SKIP() << path << " is absent; set AGVD_MESHES to its folder";
    const TriangleMesh mesh = cleaned(path);
    const double diagonal = diagonal_of(mesh);
    for (const double sites : {200., 2000., 5000.}) {
        // Most have some diagonals of edges above 40 degrees, nefertiti 12.
        EXPECT_LT(find(mesh, diagonal, sites).length, 0.1) << sites;
    }
}

INSTANTIATE_TEST_SUITE_P(Creases, RealScan,
                         testing::Values("data/organic.ply", "3holes.off", "hole_capsule.off",
                                         "fertility.off", "bunny.off", "armadillo.obj",
                                         "nefertiti.obj", "camelhead.off", "rocker-arm.obj",
                                         "spot.obj"));
