#include "remesh/sites/size_field.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "agvd/mesh/surface_points.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Surface;
using agvd::SurfacePoint;
using agvd::Vec3;
using remesh::SizeField;

namespace {

double wanted(const Vec3& at) { return 0.1 + 0.2 * at.x() + 0.05 * at.y(); }

// On a plane whose base has other triangles and more vertices than the input.
struct SizeFieldOnAPlane : testing::Test {
    static Surface plane() {
        agvd::TriangleMesh mesh = shapes::grid(3);
        shapes::add_flat_vertices(mesh, 40, 3);
        return agvd::build_surface(mesh.view());
    }
    const Surface surface = plane();
    const std::shared_ptr<const agvd::IntrinsicTriangulation> base =
        std::make_shared<const agvd::IntrinsicTriangulation>(
            surface, agvd::IntrinsicOptions{.max_length = 0.1, .min_length = 0.02});
    const SizeField field = make();

    SizeField make() const {
        std::vector<double> length;
        for (const Vec3& p : base->surface().mesh.positions) length.push_back(wanted(p));
        return {base, length};
    }
};

}  // namespace

TEST_F(SizeFieldOnAPlane, IsLinearInBetween) {
    ASSERT_GT(base->counts().splits, 0u);
    ASSERT_GT(base->counts().removed, 0u);
    for (const SurfacePoint& p : agvd::uniform_points(surface, 300, 1)) {
        EXPECT_NEAR(field.at(p), wanted(agvd::position(surface.mesh.view(), p)), 1e-12);
    }
}

TEST_F(SizeFieldOnAPlane, MeasuresAreasInSquaresOfTheLength) {
    double sum = 0;
    for (const double area : field.area_of_face()) sum += area;
    EXPECT_NEAR(sum, field.area(), 1e-9 * field.area());
    // The integral of (a + b x + c y)^-2 over the unit square by its formula.
    const auto part = [](double a) { return std::log(a); };
    const double exact =
        (part(0.1 + 0.2) + part(0.1 + 0.05) - part(0.1) - part(0.1 + 0.25)) / (0.2 * 0.05);
    EXPECT_NEAR(field.area() / exact, 1, 0.03);
}

TEST_F(SizeFieldOnAPlane, KnowsTheLeastLengthOfEachFace) {
    EXPECT_DOUBLE_EQ(field.least(), 0.1);
    for (Index f = 0; f < surface.num_faces(); ++f) {
        double least = 1;
        for (const Index v : surface.mesh.triangles[f]) {
            least = std::min(least, wanted(surface.mesh.positions[v]));
        }
        EXPECT_NEAR(field.least_in_face()[f], least, 1e-12);
    }
}
