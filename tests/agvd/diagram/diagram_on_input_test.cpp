
#include <gtest/gtest.h>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// Long triangles around a tube with a boundary: most are flipped.
TriangleMesh needle_tube() {
    TriangleMesh mesh = shapes::tube(40, 6);
    for (Vec3& p : mesh.positions) p.z() *= 8;
    return mesh;
}

double length_in_space(const Surface& surface, const Diagram& diagram, Index edge) {
    double sum = 0;
    for (Index i = diagram.edge_points[edge]; i + 1 < diagram.edge_points[edge + 1]; ++i) {
        sum += (position(surface.mesh.view(), diagram.points[i + 1]) -
                position(surface.mesh.view(), diagram.points[i]))
                   .norm();
    }
    return sum;
}

}  // namespace

TEST(DiagramOnInput, EdgesRunOnTheFacesOfTheInputAndKeepTheirLengths) {
    for (const TriangleMesh& mesh : {needle_tube(), shapes::jitter(shapes::sphere(3), 0.08, 3)}) {
        const Surface surface = build_surface(mesh.view());
        const IntrinsicTriangulation base(surface, {.max_length = 0.15});
        ASSERT_GT(base.counts().splits, 50u);
        const auto sites = uniform_points(surface, 30, 5);
        const auto on_base = base.to_intrinsic(sites);
        const Diagram before =
            build_diagram(base.surface(), on_base, propagate(base.surface(), on_base));
        const Diagram after = diagram_on_input(base, before);

        EXPECT_EQ(after.nearest_site.size(), surface.num_vertices());
        EXPECT_EQ(after.nearest_distance.size(), surface.num_vertices());
        EXPECT_EQ(after.vertices.size(), before.vertices.size());
        EXPECT_EQ(after.point_distance.size(), after.points.size());
        EXPECT_GT(after.points.size(), before.points.size());
        ASSERT_EQ(after.edges.size(), before.edges.size());
        for (Index e = 0; e < after.edges.size(); ++e) {
            for (Index i = after.edge_points[e]; i + 1 < after.edge_points[e + 1]; ++i) {
                const CommonFaces faces =
                    common_faces(surface, after.points[i], after.points[i + 1]);
                EXPECT_NE(faces.first, no_index) << "edge " << e << " point " << i;
            }
            if (before.edges[e].tail == no_index) continue;
            EXPECT_NEAR(length_in_space(surface, after, e), curve_length(base.surface(), before, e),
                        1e-9);
            const SurfacePoint& last = after.points[after.edge_points[e + 1] - 1];
            const SurfacePoint& head = after.vertices[after.edges[e].head];
            EXPECT_LT(
                (position(surface.mesh.view(), last) - position(surface.mesh.view(), head)).norm(),
                1e-12);
        }
    }
}
