// Spikes far longer than the rest make nearly all triangles thin and many of them intersect. Such
// meshes end without rounds that would not help.
#include <gtest/gtest.h>

#include "remesh/pipeline/remesh.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using remesh::RemeshResult;

namespace {

// A unit ball of 642 vertices, of which each fifth is the end of a spike.
TriangleMesh ball_with_spikes() {
    TriangleMesh mesh = shapes::sphere(3);
    for (Index v = 0; v < mesh.positions.size(); v += 5) mesh.positions[v] *= 30;
    return mesh;
}

}  // namespace

TEST(Spikes, HopelessResultsGetNoMoreVertices) {
    const RemeshResult result = remesh::remesh(ball_with_spikes().view(), {.num_samples = 100});
    EXPECT_EQ(result.mesh.positions.size(), 100u);
    if (!result.self_intersections) GTEST_SKIP() << "without CGAL";
    EXPECT_GT(*result.self_intersections, result.input_self_intersections + 15);
}
