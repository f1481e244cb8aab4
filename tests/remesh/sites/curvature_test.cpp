// Curvature of patches on surfaces of known curvature, whatever their triangles.
#include "remesh/sites/target_lengths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "remesh/curves/curve_network.h"
#include "support/flag_edges.h"
#include "support/parts.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Vec3;

namespace {

// Curvatures of the vertices of a surface, with their positions.
struct Curved {
    std::vector<Vec3> at;
    std::vector<double> curvature;
};

Curved curvature_of(const agvd::Surface& surface, Index num_cells, double max_length) {
    const agvd::IntrinsicTriangulation base(surface, {.max_length = max_length});
    agvd::Ticker ticker;
    return {base.surface().mesh.positions, remesh::patch_curvature(base, num_cells, ticker)};
}

Curved curvature_of(const agvd::TriangleMesh& mesh, Index num_cells, double max_length = 1) {
    return curvature_of(agvd::build_surface(mesh.view()), num_cells, max_length);
}

double quantile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

// Of the curvature over the one by formula: \param of  position -> curvature.
template <typename Of>
std::vector<double> ratios(const Curved& curved, const Of& of) {
    std::vector<double> result;
    for (std::size_t v = 0; v < curved.at.size(); ++v) {
        result.push_back(curved.curvature[v] / of(curved.at[v]));
    }
    return result;
}

double torus_curvature(const Vec3& at, double tube) {
    const double across = (std::hypot(at.x(), at.y()) - 1) / tube;  // The cosine around the tube.
    const double along = across / (1 + tube * across);
    return std::sqrt((1 / (tube * tube) + along * along) / 2);
}

}  // namespace

TEST(Curvature, OfASphereIsOneOverItsRadius) {
    for (const double radius : {0.5, 1.0, 3.0}) {
        agvd::TriangleMesh mesh = shapes::sphere(5);
        for (Vec3& p : mesh.positions) p *= radius;
        const Curved curved = curvature_of(mesh, 300);
        for (const double k : curved.curvature) EXPECT_NEAR(k * radius, 1, 0.02);
    }
}

TEST(Curvature, OfACylinderIsThatOfTheCircleOverRootTwo) {
    const Curved curved = curvature_of(shapes::tube(160, 60), 600);
    const auto ratio = ratios(curved, [](const Vec3&) { return std::numbers::sqrt2 / 2; });
    EXPECT_NEAR(quantile(ratio, 0.5), 1, 0.06);
    EXPECT_GT(quantile(ratio, 0.05), 0.75);  // Of patches that are longer along the cylinder.
    EXPECT_LT(quantile(ratio, 0.95), 1.3);
}

TEST(Curvature, OfATorusFollowsItsFormula) {
    const double tube = 0.35;
    const Curved curved = curvature_of(shapes::torus(200, 100, tube), 1500);
    const auto ratio = ratios(curved, [&](const Vec3& p) { return torus_curvature(p, tube); });
    EXPECT_NEAR(quantile(ratio, 0.5), 1, 0.06);
    EXPECT_GT(quantile(ratio, 0.02), 0.65);
    EXPECT_LT(quantile(ratio, 0.98), 1.35);
}

TEST(Curvature, DoesNotDependOnTheTriangles) {
    const double tube = 0.35;
    agvd::TriangleMesh needles = shapes::torus(80, 40, tube);
    shapes::add_flat_vertices(needles, 3000, 5);
    // Long strips: a quarter of the vertices around the tube are left on each of 400 circles.
    for (const agvd::TriangleMesh& mesh : {needles, shapes::torus(400, 30, tube)}) {
        const Curved curved = curvature_of(mesh, 600, 0.1);
        const auto ratio = ratios(curved, [&](const Vec3& p) { return torus_curvature(p, tube); });
        EXPECT_NEAR(quantile(ratio, 0.5), 1, 0.06);
        EXPECT_GT(quantile(ratio, 0.05), 0.65);
        EXPECT_LT(quantile(ratio, 0.95), 1.35);
    }
}

TEST(Curvature, IsZeroBetweenCreasesThatAreCut) {
    for (const Index n : {1u, 6u}) {
        const agvd::Surface whole = agvd::build_surface(parts::box({1, 2, 3}, n).view());
        const remesh::CutSurface cut = remesh::cut_surface(whole, flag_sharp_edges(whole));
        for (const double k : curvature_of(cut.surface(), 400, 0.2).curvature) {
            EXPECT_LT(k, 1e-6);
        }
        const Curved uncut = curvature_of(whole, 400, 0.2);
        EXPECT_GT(*std::max_element(uncut.curvature.begin(), uncut.curvature.end()), 1);
    }
}
