// Whatever comes in: an oriented manifold comes out, or a named reason why not.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "agvd/core/error.h"
#include "agvd/core/random.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/topology.h"
#include "remesh/clean/clean_input.h"
#include "support/dirty_shapes.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using remesh::CleanResult;

namespace {

double area(const TriangleMesh& mesh) {
    double sum = 0;
    std::set<agvd::Triangle> seen;  // Duplicates count once.
    for (agvd::Triangle t : mesh.triangles) {
        const auto& p = mesh.positions;
        const double part = (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm() / 2;
        std::sort(t.begin(), t.end());
        if (seen.insert(t).second) sum += part;
    }
    return sum;
}

// Returns whether the mesh could be repaired.
bool expect_repaired(const TriangleMesh& mesh) {
    CleanResult clean;
    try {
        clean = remesh::clean_input(mesh.view());
    } catch (const agvd::InvalidInput& error) {
        const std::string text = error.what();
        EXPECT_TRUE(text.find("not orientable") != std::string::npos ||
                    text.find("no face") != std::string::npos)
            << text;
        return false;
    }
    EXPECT_NO_THROW((void)agvd::build_surface(clean.mesh.view()));
    const remesh::Topology topology = remesh::analyze_topology(clean.mesh.view());
    EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
    EXPECT_EQ(clean.vertex_origin.size(), clean.mesh.positions.size());
    EXPECT_EQ(clean.face_origin.size(), clean.mesh.triangles.size());
    for (Index v = 0; v < clean.mesh.positions.size(); ++v) {
        EXPECT_EQ(clean.mesh.positions[v], mesh.positions.at(clean.vertex_origin[v]));
    }
    const remesh::CleanCounts& counts = clean.counts;
    EXPECT_EQ(mesh.triangles.size() + counts.divided_edges - clean.mesh.triangles.size(),
              counts.degenerate_faces + counts.duplicate_faces);
    EXPECT_EQ(mesh.positions.size() + counts.split_vertices - clean.mesh.positions.size(),
              counts.welded_vertices + counts.isolated_vertices);
    if (counts.welded_vertices + counts.duplicate_faces + counts.divided_edges == 0) {
        const double twice = counts.touching_faces > 0 ? area(mesh) : 0;  // At most: walls stay.
        EXPECT_GE(area(clean.mesh), (1 - 1e-12) * area(mesh)) << "geometry is unchanged";
        EXPECT_LE(area(clean.mesh), (1 + 1e-12) * area(mesh) + twice) << "geometry is unchanged";
    }
    return true;
}

}  // namespace

TEST(CleanInputProperty, RandomSoupsBecomeManifoldOrAreRefused) {
    int repaired = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        const auto vertices = static_cast<Index>(4 + agvd::random_bits(seed, 6, 0) % 30);
        const auto faces = static_cast<Index>(1 + agvd::random_bits(seed, 7, 0) % 60);
        repaired += expect_repaired(shapes::random_soup(vertices, faces, seed)) ? 1 : 0;
        if (HasFailure()) FAIL() << "seed " << seed;
    }
    EXPECT_GT(repaired, 1000);
}

TEST(CleanInputProperty, DamagedShapesBecomeManifoldOrAreRefused) {
    const std::vector<TriangleMesh> models{shapes::sphere(1),
                                           shapes::grid(5),
                                           shapes::torus(7, 5),
                                           shapes::join(shapes::tube(6, 3), shapes::cube()),
                                           shapes::book(5),
                                           shapes::cubes_on_an_edge(),
                                           shapes::hourglass(),
                                           shapes::filled_slit(12),
                                           shapes::unweld(shapes::cube())};
    int repaired = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        const auto times = static_cast<Index>(agvd::random_bits(seed, 9, 0) % 25);
        repaired +=
            expect_repaired(shapes::damage(models[seed % models.size()], times, seed)) ? 1 : 0;
        if (HasFailure()) FAIL() << "seed " << seed;
    }
    EXPECT_GT(repaired, 1000);
}

TEST(CleanInputProperty, DenseSoupsWithManySheetsPerEdge) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        expect_repaired(shapes::random_soup(8, 2000, seed));
        expect_repaired(shapes::book(static_cast<Index>(3 + 3 * seed)));
        if (HasFailure()) FAIL() << "seed " << seed;
    }
}
