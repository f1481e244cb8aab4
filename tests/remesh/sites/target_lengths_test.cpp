#include "remesh/sites/target_lengths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "remesh/sites/size_field.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Surface;
using remesh::AdaptiveEdges;
using remesh::Sizing;
using remesh::VertexDensities;
using remesh::VertexLengths;

namespace {

struct TargetLengthsOfATorus : testing::Test {
    const Surface surface = agvd::build_surface(shapes::torus(120, 60).view());

    std::vector<double> values(double ratio) const {
        std::vector<double> result;
        for (const agvd::Vec3& p : surface.mesh.positions) {
            result.push_back(std::pow(ratio, (1 + p.x() / 1.35) / 2));
        }
        return result;
    }
    std::vector<double> run(const Sizing& sizing, const std::vector<double>& of,
                            double area) const {
        agvd::Ticker ticker;
        return remesh::target_lengths(surface, of, {}, {}, sizing, area, ticker);
    }
};

std::pair<double, double> range(const std::vector<double>& values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return {*least, *most};
}

}  // namespace

TEST(LengthForError, IsThatOfATriangleInASphere) {
    for (const double radius : {1.0, 2.5}) {
        for (const double error : {1e-4, 0.01, 0.3}) {
            const double length = remesh::length_for_error(1 / radius, error);
            // The middle of the triangle is at this distance from the centre.
            const double middle = std::sqrt(radius * radius - length * length / 3);
            EXPECT_NEAR(radius - middle, error, 1e-12);
        }
    }
    EXPECT_EQ(remesh::length_for_error(0, 0.1), std::numeric_limits<double>::infinity());
    EXPECT_DOUBLE_EQ(remesh::length_for_error(1e9, 0.1), 0.1 * std::sqrt(3));
}

TEST_F(TargetLengthsOfATorus, TheAreaComesOut) {
    const std::vector<double> wanted = values(10);
    Index num_tried = 0;
    for (const double gradation : {1.05, 1.3, 4.0}) {
        for (const double area : {50.0, 2000.0, 1e5}) {
            for (const int kind : {0, 1, 2}) {
                Sizing sizing{.edges = AdaptiveEdges{}, .gradation = gradation};
                if (kind == 1) sizing.edges = VertexLengths{wanted};
                if (kind == 2) sizing.edges = VertexDensities{wanted};
                const auto targets = run(sizing, wanted, area);
                EXPECT_NEAR(remesh::area_in_lengths(surface, targets) / area, 1, 1e-9);
                ++num_tried;
            }
        }
    }
    EXPECT_EQ(num_tried, 27u);
}

TEST_F(TargetLengthsOfATorus, AreScaledOrTakenAsTheyAre) {
    const std::vector<double> wanted = values(2);
    const Sizing loose{.edges = VertexLengths{wanted}, .gradation = 1000};
    EXPECT_EQ(run(loose, wanted, 0), wanted);
    const auto scaled = run(loose, wanted, 800);
    const Sizing by_density{.edges = VertexDensities{wanted}, .gradation = 1000};
    const auto dense = run(by_density, wanted, 800);
    const Sizing by_curvature{.edges = AdaptiveEdges{}, .gradation = 1000};
    const auto curved = run(by_curvature, wanted, 800);
    for (std::size_t v = 0; v < wanted.size(); ++v) {
        EXPECT_NEAR(scaled[v] / scaled[0], wanted[v] / wanted[0], 1e-12);
        EXPECT_NEAR(dense[v] / dense[0], std::sqrt(wanted[0] / wanted[v]), 1e-12);
        EXPECT_NEAR(curved[v] / curved[0], std::cbrt(wanted[0] / wanted[v]), 1e-12);
    }
}

TEST_F(TargetLengthsOfATorus, KeepTheirBounds) {
    const std::vector<double> wanted = values(30);
    const double mean = std::sqrt(agvd::surface_area(surface) / 1000);
    const auto free = range(run({.edges = VertexLengths{wanted}}, wanted, 1000));
    const auto bounded =
        run({.edges = VertexLengths{wanted}, .min_edge = mean / 2, .max_edge = 1.6 * mean}, wanted,
            1000);
    const auto [least, most] = range(bounded);
    EXPECT_LT(free.first, 0.45 * mean);
    EXPECT_GT(free.second, 1.7 * mean);
    EXPECT_NEAR(least / (mean / 2), 1, 0.01);
    EXPECT_NEAR(most / (1.6 * mean), 1, 0.01);
    // Bounds that exclude the number give way: the lengths are equal then.
    const auto forced =
        range(run({.edges = VertexLengths{wanted}, .max_edge = mean / 3}, wanted, 1000));
    EXPECT_NEAR(forced.first, mean, 1e-9);
    EXPECT_NEAR(forced.second, mean, 1e-9);
}

TEST_F(TargetLengthsOfATorus, GrowNoFasterThanTheGradationAlongGeodesics) {
    // A base as runs have it: paths along its edges are not much longer than geodesics.
    const agvd::IntrinsicTriangulation base(surface, {.max_length = 0.1});
    std::vector<double> wanted;
    for (Index v = 0; v < base.surface().num_vertices(); ++v) {
        wanted.push_back(v % 97 == 0 ? 0.02 : 1);
    }
    Index num_tried = 0;
    for (const double gradation : {1.1, 1.3}) {
        agvd::Ticker ticker;
        const Sizing sizing{.edges = VertexLengths{wanted}, .gradation = gradation};
        const auto length =
            remesh::target_lengths(base.surface(), wanted, {}, {}, sizing, 3000, ticker);
        for (Index site = 0; site < base.surface().num_vertices(); site += 731) {
            const auto distance =
                agvd::propagate(base.surface(), std::vector{agvd::point_at(base.surface(), site)},
                                {.max_error = 0.0})
                    .vertex_distance;
            for (Index v = 0; v < distance.size(); ++v) {
                EXPECT_LE(length[v] - length[site], std::log(gradation) * distance[v] + 1e-12);
                ++num_tried;
            }
        }
    }
    EXPECT_GT(num_tried, 50'000u);
}

TEST_F(TargetLengthsOfATorus, AreThoseOfTheErrorWhereOneIsGiven) {
    const std::vector<double> curvature(surface.num_vertices(), 2);
    const auto targets =
        run({.edges = AdaptiveEdges{}, .count = remesh::MaxError{1e-3}}, curvature, 0);
    for (const double length : targets) {
        EXPECT_DOUBLE_EQ(length, remesh::length_for_error(2 * std::sqrt(2), 1e-3));
    }
}
