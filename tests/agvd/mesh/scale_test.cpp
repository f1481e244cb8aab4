#include "agvd/mesh/scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "agvd/core/error.h"
#include "agvd/mesh/surface.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

TriangleMesh cube_of(double size) {
    TriangleMesh mesh = shapes::cube();
    for (Vec3& p : mesh.positions) p *= size;
    return mesh;
}

}  // namespace

TEST(Scale, AVertexFarFromAllOthersIsNamed) {
    TriangleMesh mesh = shapes::sphere(3);
    for (const double far : {1e9, 1e12, 1e300}) {
        mesh.positions[77] = {0, far, 0};
        std::string text;
        try {
            check_spread(mesh.view(), box_of(mesh.view()));
        } catch (const InvalidInput& error) {
            text = error.what();
        }
        EXPECT_EQ(text.starts_with("vertex 77 is 1"), far > 1e10) << text;
    }
    // One of two parts may be far away, and any part small.
    const TriangleMesh speck =
        shapes::join(shapes::sphere(3), scaled(shapes::sphere(2).view(), -50));
    EXPECT_NO_THROW(check_spread(speck.view(), box_of(speck.view())));
    TriangleMesh parts = shapes::join(shapes::sphere(2), shapes::sphere(2));
    for (std::size_t v = 0; v < parts.positions.size() / 2; ++v) parts.positions[v].x() += 1e12;
    EXPECT_NO_THROW(check_spread(parts.view(), box_of(parts.view())));
}

TEST(Scale, ASurfaceOfNeedlesIsRefused) {
    const agvd::Progress none;
    agvd::Poller poller(none);
    agvd::Ticker ticker(poller);
    // Its sides are needles, its ends are not.
    const auto prism = [](double length) {
        TriangleMesh mesh;
        mesh.positions = {{0, 0, 0},      {1, 0, 0},      {0, 1, 0},
                          {0, 0, length}, {1, 0, length}, {0, 1, length}};
        mesh.triangles = {{0, 2, 1}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5},
                          {1, 5, 4}, {2, 0, 3}, {2, 3, 5}, {3, 4, 5}};
        return mesh;
    };
    for (const double length : {1e3, 1e10, 1e12, 1e30}) {
        std::string text;
        try {
            check_width(prism(length).view(), ticker);
        } catch (const InvalidInput& error) {
            text = error.what();
        }
        EXPECT_EQ(text.starts_with("most of the surface consists of needles, such as face "),
                  length > 1e11)
            << text;
    }
    // A needle of a small share of the area is for cleaning and for the intrinsic triangulation.
    TriangleMesh mesh = shapes::sphere(3);
    const auto first = static_cast<Index>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1e-12, 0}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    EXPECT_NO_THROW(check_width(mesh.view(), ticker));
    EXPECT_NO_THROW(check_width({}, ticker));
}

TEST(Scale, ExtentIsThatOfTheFaces) {
    TriangleMesh mesh = cube_of(3);
    mesh.positions.emplace_back(100, 0, 0);  // In no face.
    mesh.positions[mesh.triangles[0][0]].x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(box_of(mesh.view()).longest_side(), 3);
    EXPECT_EQ(box_of({}).longest_side(), 0);
    EXPECT_EQ(box_of(cube_of(1e308).view()).longest_side(), 1e308);
    mesh = cube_of(1);
    for (Vec3& p : mesh.positions) p = (p - Vec3(0.5, 0.5, 0.5)) * 2 * 1.7e308;
    EXPECT_EQ(box_of(mesh.view()).longest_side(), std::numeric_limits<double>::max());
}

TEST(Scale, BoxIsTheSameForAnyNumberOfThreads) {
    const TriangleMesh mesh = shapes::torus(120, 120);  // Several chunks.
    MeshBox expected;
    for (const Vec3& p : mesh.positions) expected.add(p);
    for (const int num_threads : {1, 2, 8}) {
        EXPECT_EQ(box_of(mesh.view(), num_threads).low, expected.low);
        EXPECT_EQ(box_of(mesh.view(), num_threads).high, expected.high);
    }
    EXPECT_TRUE(box_of({}).is_empty());
}

TEST(Scale, RangeEndsAtTwoToTheEighty) {
    EXPECT_TRUE(is_in_scale(0));
    EXPECT_TRUE(is_in_scale(0x1p80));
    EXPECT_TRUE(is_in_scale(0x1p-80));
    EXPECT_FALSE(is_in_scale(0x1.1p80));
    EXPECT_FALSE(is_in_scale(0x0.fp-80));
    EXPECT_THROW((void)build_surface(cube_of(1e-40).view()), InvalidInput);
    EXPECT_THROW((void)build_surface(cube_of(1e40).view()), InvalidInput);
    EXPECT_NO_THROW((void)build_surface(cube_of(1e20).view()));
}

TEST(Scale, ScaledAndBackIsTheSame) {
    const TriangleMesh mesh = shapes::jitter(shapes::sphere(2), 0.1, 3);
    const TriangleMesh small = scaled(mesh.view(), -300);
    EXPECT_EQ(small.positions[7].x(), std::ldexp(mesh.positions[7].x(), -300));
    EXPECT_EQ(scaled(small.view(), 300).positions, mesh.positions);
    EXPECT_EQ(small.triangles, mesh.triangles);
}

TEST(Scale, DigitsRunOutFarFromTheOrigin) {
    TriangleMesh mesh = shapes::cube();
    for (Vec3& p : mesh.positions) p.z() -= 0x1p43 * 1.1;
    EXPECT_THROW(check_digits(box_of(mesh.view())), InvalidInput);
    mesh = shapes::cube();
    for (Vec3& p : mesh.positions) p.z() -= 0x1p42;
    EXPECT_NO_THROW(check_digits(box_of(mesh.view())));
}
