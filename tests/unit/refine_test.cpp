#include "agvd/mesh/refine.h"

#include <gtest/gtest.h>

#include "agvd/mesh/surface.h"
#include "remesh/quality/topology.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

double area(const TriangleMesh& mesh) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3& p = mesh.positions[a];
        sum += (mesh.positions[b] - p).cross(mesh.positions[c] - p).norm() / 2;
    }
    return sum;
}

}  // namespace

TEST(Refine, NoEdgeStaysLongAndTheSurfaceStaysTheSame) {
    for (const TriangleMesh& mesh : {shapes::cube(), shapes::tube(5, 1), shapes::grid(1),
                                     shapes::jitter(shapes::torus(7, 5), 0.1, 3)}) {
        for (const double max_length : {0.7, 0.31, 0.1}) {
            const RefinedMesh refined = split_long_edges(mesh.view(), max_length);
            const Surface surface = build_surface(refined.mesh.view());
            for (const double length : surface.length) EXPECT_LE(length, max_length);
            EXPECT_NEAR(area(refined.mesh), area(mesh), 1e-12 * area(mesh));
            EXPECT_TRUE(same_topology(remesh::analyze_topology(mesh.view()),
                                      remesh::analyze_topology(refined.mesh.view())));
        }
    }
}

TEST(Refine, EachFaceIsPartOfItsOrigin) {
    const TriangleMesh mesh = shapes::jitter(shapes::torus(7, 5), 0.1, 3);
    const RefinedMesh refined = split_long_edges(mesh.view(), 0.2);
    std::vector<double> parts(mesh.triangles.size(), 0);
    for (Index f = 0; f < refined.mesh.triangles.size(); ++f) {
        const TriangleMesh face{refined.mesh.positions, {refined.mesh.triangles[f]}};
        parts[refined.face_origin[f]] += area(face);
    }
    for (Index f = 0; f < parts.size(); ++f) {
        const TriangleMesh face{mesh.positions, {mesh.triangles[f]}};
        EXPECT_NEAR(parts[f], area(face), 1e-12);
    }
}

TEST(Refine, ShortEdgesLeaveTheMeshAsItIs) {
    const TriangleMesh mesh = shapes::sphere(2);
    EXPECT_FALSE(has_long_edges(mesh.view(), 3));
    EXPECT_TRUE(has_long_edges(mesh.view(), 0.2));
    const RefinedMesh refined = split_long_edges(mesh.view(), 3);
    EXPECT_EQ(refined.mesh.triangles, mesh.triangles);
    EXPECT_EQ(refined.mesh.positions, mesh.positions);
}
