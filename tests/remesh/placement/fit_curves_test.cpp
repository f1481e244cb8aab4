// Vertices of creases leave them so that the chain lies nearer.
#include "remesh/placement/placement.h"

#include <gtest/gtest.h>

#include <numbers>

#include "support/flag_edges.h"
#include "support/parts.h"

using agvd::Index;
using agvd::Surface;
using agvd::Vec3;
using remesh::Curve;
using remesh::CurveSites;

namespace {

constexpr double pi = std::numbers::pi;

struct Fitted {
    Fitted(const agvd::TriangleMesh& mesh, double spacing)
        : surface(agvd::build_surface(mesh.view())) {
        const std::vector<std::uint8_t> flags = flag_sharp_edges(surface);
        network = remesh::find_network(surface, flags, spacing);
        const remesh::CutSurface cut = remesh::cut_surface(surface, flags);
        intervals = remesh::curve_intervals(surface, network, spacing);
        sites = remesh::curve_sites_at(
            network, cut, remesh::even_positions(cut.surface(), network, spacing, intervals));
        offsets = remesh::fit_curves(surface, network, sites);
    }

    [[nodiscard]] Vec3 on(const Curve& curve, double along) const {
        return position(surface.mesh.view(), remesh::point_on_curve(curve, along));
    }

    // Root of the mean squared distance between a closed curve and its chain at equal shares.
    [[nodiscard]] double error(std::size_t c, bool is_fitted) const {
        constexpr int num_points = 50;
        const Curve& curve = network.curves[c];
        const Index first = sites.first_of_curve[c], count = intervals[c];
        double sum = 0;
        for (Index i = 0; i < count; ++i) {
            const Index g = first + i, h = first + (i + 1) % count;
            const double begin = sites.along[g];
            const double end = sites.along[h] + (i + 1 == count ? curve.length() : 0);
            Vec3 a = on(curve, begin), b = on(curve, end);
            if (is_fitted) {
                a += offsets[g];
                b += offsets[h];
            }
            for (int k = 0; k < num_points; ++k) {
                const double share = (k + .5) / num_points;
                const Vec3 on_chain = (1 - share) * a + share * b;
                sum += (on(curve, begin + share * (end - begin)) - on_chain).squaredNorm();
            }
        }
        return std::sqrt(sum / (count * num_points));
    }

    Surface surface;
    remesh::CurveNetwork network;
    std::vector<Index> intervals;
    CurveSites sites;
    std::vector<Vec3> offsets;
};

}  // namespace

TEST(FitCurves, StraightCurvesAndNodesStay) {
    const Fitted box(parts::box({1, 1, 1}, 6), .23);
    ASSERT_EQ(box.offsets.size(), box.sites.num_groups());
    for (const Vec3& offset : box.offsets) EXPECT_LT(offset.norm(), 1e-14);
}

TEST(FitCurves, ChainsOfCirclesLieHalfInsideHalfOutside) {
    const Fitted cylinder(parts::capped_cylinder(240, 2), .5);
    for (std::size_t c = 0; c < 2; ++c) {
        const Index count = cylinder.intervals[c];
        const double height = 1 - std::cos(pi / count);  // Of the arcs above their chords.
        for (Index g = cylinder.sites.first_of_curve[c]; g < cylinder.sites.first_of_curve[c + 1];
             ++g) {
            const Vec3 at = cylinder.on(cylinder.network.curves[c], cylinder.sites.along[g]);
            const Vec3 out = Vec3(at.x(), at.y(), 0).normalized();
            EXPECT_NEAR(cylinder.offsets[g].dot(out) / (2 * height / 3), 1, 0.1);
            EXPECT_NEAR(cylinder.offsets[g].z(), 0, 1e-14);
            EXPECT_LT((cylinder.offsets[g] - cylinder.offsets[g].dot(out) * out).norm(),
                      0.1 * height);
        }
        // Of a parabola: sqrt(8 / 15 - 4 / 9) for sqrt(8 / 15).
        EXPECT_NEAR(cylinder.error(c, true) / cylinder.error(c, false), .41, .02);
    }
}

TEST(FitCurves, TheBoundaryStays) {
    // A circle between cone and plate, and the plate's boundary.
    const Fitted cone(parts::cone_on_plate(96, 4), .5);
    for (std::size_t c = 0; c < 2; ++c) {
        const Curve& curve = cone.network.curves[c];
        const bool is_crease = curve.is_crease();
        for (Index g = cone.sites.first_of_curve[c]; g < cone.sites.first_of_curve[c + 1]; ++g) {
            EXPECT_EQ(cone.offsets[g].isZero(0), !is_crease);
        }
    }
}

TEST(FitCurves, OpenCurvesAreFittedBetweenTheirEnds) {
    const Fitted vaults(parts::crossing_vaults(40), .4);
    for (std::size_t c = 0; c < vaults.network.curves.size(); ++c) {
        const Curve& curve = vaults.network.curves[c];
        if (!curve.is_crease()) continue;
        const Index first = vaults.sites.first_of_curve[c];
        ASSERT_GT(vaults.intervals[c], 4u);
        const Index middle = first + (vaults.intervals[c] - 1) / 2;
        // The curve is an arch: up in its middle.
        EXPECT_GT(vaults.offsets[middle].z(), 1e-3);
        // It is its own mirror image.
        const Index last = vaults.sites.first_of_curve[c + 1] - 1;
        for (Index k = 0; first + k < last - k; ++k) {
            const Vec3 a = vaults.offsets[first + k], b = vaults.offsets[last - k];
            EXPECT_LT((a - Vec3(b.x(), -b.y(), b.z())).norm(), 1e-6);
        }
        EXPECT_TRUE(vaults.offsets[curve.begin].isZero(0));
        EXPECT_TRUE(vaults.offsets[curve.end].isZero(0));
    }
}
