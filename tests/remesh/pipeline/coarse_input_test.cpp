// Few samples on many faces run on a coarse surface; what they give is told for the input itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/transfer/transfer.h"
#include "support/junction_shapes.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;

namespace {

constexpr Index few_samples = 200;

// 81 920 faces.
const TriangleMesh& fine_sphere() {
    static const TriangleMesh sphere = shapes::sphere(6);
    return sphere;
}

TriangleMesh fine_cube() {
    TriangleMesh cube = shapes::cube();
    for (int i = 0; i < 6; ++i) cube = shapes::subdivide(cube);
    return cube;
}

TEST(CoarseInput, StandsForManyFacesAndOnlyForThem) {
    const auto coarse_faces = [](const TriangleMesh& mesh, const remesh::RemeshOptions& options) {
        return remesh::remesh(mesh.view(), options).coarse_faces;
    };
    const Index faces = coarse_faces(fine_sphere(), {.num_samples = few_samples});
    EXPECT_LE(faces, 20'000u);
    EXPECT_GE(faces, 19'998u);
    // Edges may not get longer, so not all faces go that could.
    const Index for_more_samples = coarse_faces(fine_sphere(), {.num_samples = 1638});
    EXPECT_GE(for_more_samples, 26'208u);
    EXPECT_LT(for_more_samples, 40'000u);
    EXPECT_EQ(coarse_faces(fine_sphere(), {.num_samples = 1639}), 0u);
    EXPECT_EQ(coarse_faces(shapes::sphere(5), {.num_samples = few_samples}), 0u);  // 20 480 faces.
}

TEST(CoarseInput, IsNotUsedWhereTheInputItselfCounts) {
    const Index num_faces = static_cast<Index>(fine_sphere().triangles.size());
    remesh::RemeshOptions exact{.num_samples = few_samples}, fixed = exact, sized = exact,
                                                             near = exact, labels = exact;
    exact.propagation.max_error = 0;
    fixed.fit = false;
    std::vector<double> lengths(fine_sphere().positions.size(), 0.3);
    lengths.front() = 0.2;
    sized.sizing.edges = remesh::VertexLengths{lengths};
    near.sizing.count = remesh::MaxDistance{0.05};
    labels.face_labels.assign(num_faces, 1);
    int count = 0;
    for (const remesh::RemeshOptions& options : {exact, fixed, sized, near, labels}) {
        EXPECT_EQ(remesh::remesh(fine_sphere().view(), options).coarse_faces, 0u) << count;
        ++count;
    }
    EXPECT_EQ(count, 5);
}

TEST(CoarseInput, TheResultIsAsGoodAsWithout) {
    const auto made = [](std::optional<double> max_error) {
        remesh::RemeshOptions options{.num_samples = few_samples};
        options.propagation.max_error = max_error;
        return remesh::remesh(fine_sphere().view(), options);
    };
    const remesh::RemeshResult coarse = made({}), whole = made(0);
    ASSERT_GT(coarse.coarse_faces, 0u);
    ASSERT_EQ(whole.coarse_faces, 0u);
    EXPECT_EQ(coarse.mesh.positions.size(), few_samples);
    EXPECT_LT(coarse.verdict.largest_distance, 1.2 * whole.verdict.largest_distance);
    EXPECT_GT(coarse.verdict.min_angle, whole.verdict.min_angle - 6);
    EXPECT_NEAR(shapes::signed_volume(coarse.mesh), shapes::signed_volume(whole.mesh), 0.01);
}

TEST(CoarseInput, SitesLieOnTheInputBelowTheirVertices) {
    const remesh::RemeshResult result =
        remesh::remesh(fine_sphere().view(), {.num_samples = few_samples});
    ASSERT_GT(result.coarse_faces, 0u);
    ASSERT_EQ(result.sites.size(), result.mesh.positions.size());
    int num_inside = 0;  // Of faces.
    for (Index v = 0; v < result.sites.size(); ++v) {
        const auto& corners = result.sites[v].barycentric;
        if (std::ranges::max(corners) < 0.999) ++num_inside;
        const Vec3 site = agvd::position(fine_sphere().view(), result.sites[v]);
        EXPECT_GT(site.norm(), 0.9995);  // The coarse surface reaches down to .995.
        // Fitted vertices have slid, by less than a spacing.
        EXPECT_LT((site - result.mesh.positions[v]).norm(), 0.25);
    }
    EXPECT_GT(num_inside, 100);
}

// Vertices of faces far apart in memory are put in another order: sites name the caller's faces.
TEST(CoarseInput, SitesOfAScatteredMeshLieOnTheFacesThatTheyName) {
    const TriangleMesh sphere = shapes::shuffle(fine_sphere());
    remesh::RemeshOptions options{.num_samples = few_samples};
    const remesh::RemeshResult of_view = remesh::remesh(sphere.view(), options);
    const remesh::RemeshResult of_moved = remesh::remesh_moved(sphere, options);
    EXPECT_EQ(of_view.mesh.positions, of_moved.mesh.positions);
    ASSERT_EQ(of_view.sites.size(), few_samples);
    ASSERT_EQ(of_moved.sites.size(), few_samples);
    for (Index v = 0; v < few_samples; ++v) {
        EXPECT_EQ(of_view.sites[v].face, of_moved.sites[v].face);
        const Vec3 site = agvd::position(sphere.view(), of_moved.sites[v]);
        EXPECT_LT((site - of_moved.mesh.positions[v]).norm(), 0.25) << v;
    }
}

// All twelve creases, found on the input and followed by the coarse surface.
TEST(CoarseInput, CreasesOfTheInputAreKept) {
    const TriangleMesh cube = fine_cube();
    const remesh::RemeshResult result = remesh::remesh(cube.view(), {.num_samples = 300});
    ASSERT_GT(result.coarse_faces, 0u);
    EXPECT_EQ(result.features.curves, 12u);
    EXPECT_NEAR(result.features.length, 12, 1e-9);
    EXPECT_NEAR(shapes::signed_volume(result.mesh), shapes::signed_volume(cube), 1e-9);
    EXPECT_EQ(remesh::remesh(cube.view(), {.num_samples = 300, .features = remesh::Features::Off})
                  .features.length,
              0);
}

TEST(CoarseInput, ABoundaryKeepsItsOutline) {
    const agvd::Surface tube = agvd::build_surface(shapes::tube(600, 200).view());
    const remesh::RemeshResult result =
        remesh::remesh(tube.mesh.view(), {.num_samples = few_samples});
    ASSERT_GT(result.coarse_faces, 0u);
    const agvd::Surface made = agvd::build_surface(result.mesh.view());
    int count = 0;
    for (Index v = 0; v < made.num_vertices(); ++v) {
        if (!made.is_boundary_vertex(v)) continue;
        double distance = 1;
        for (Index h = 0; h < tube.twin.size(); ++h) {
            if (tube.twin[h] != agvd::no_index) continue;
            distance =
                std::min(distance, agvd::distance_to_segment(made.mesh.positions[v],
                                                             tube.mesh.positions[tube.tail(h)],
                                                             tube.mesh.positions[tube.head(h)]));
        }
        EXPECT_LT(distance, 1e-9);
        ++count;
    }
    EXPECT_GT(count, 10);
}

TEST(CoarseInput, TheNumberOfThreadsChangesNothing) {
    remesh::RemeshOptions options{.num_samples = few_samples, .num_threads = 1};
    const remesh::RemeshResult one = remesh::remesh(fine_sphere().view(), options);
    options.num_threads = 3;
    const remesh::RemeshResult three = remesh::remesh(fine_sphere().view(), options);
    ASSERT_GT(one.coarse_faces, 0u);
    EXPECT_EQ(one.mesh.positions, three.mesh.positions);
    EXPECT_EQ(one.mesh.triangles, three.mesh.triangles);
}

// Two bodies share a wall; their sheets still meet.
TEST(CoarseInput, SheetsStillMeet) {
    const shapes::JunctionShape shape = shapes::cubes_with_a_wall();
    TriangleMesh mesh = shape.mesh;
    for (int i = 0; i < 5; ++i) mesh = shapes::subdivide(mesh);
    remesh::RemeshOptions options{.num_samples = 300, .junctions = remesh::Junctions::Keep};
    const remesh::RemeshResult result = remesh::remesh(mesh.view(), options);
    ASSERT_GT(result.coarse_faces, 0u);
    EXPECT_GT(result.junctions.welded_edges, 0u);
    EXPECT_EQ(result.self_intersections.value_or(0), 0u);
}

}  // namespace
