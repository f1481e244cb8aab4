#include "paper/compare_diagrams.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "agvd/core/error.h"
#include "agvd/diagram/diagram.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/propagation/propagate.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// Sites on the middle line y = 1/2 of the unit square, whose cells are rectangles.
class CompareStrips : public testing::Test {
protected:
    [[nodiscard]] std::vector<SurfacePoint> sites_at(std::initializer_list<double> xs) const {
        std::vector<SurfacePoint> sites;
        const ClosestPointTree tree(surface_.mesh.view());
        for (const double x : xs) sites.push_back(tree.query({x, 0.5, 0}).point);
        return sites;
    }
    [[nodiscard]] Diagram strips(std::initializer_list<double> xs) const {
        const auto sites = sites_at(xs);
        return build_diagram(surface_, sites, propagate(surface_, sites, {.max_error = 0}));
    }

    Surface surface_ = build_surface(shapes::jitter(shapes::grid(9), 0, 1).view());
    double radius_of_two_ = std::sqrt(0.5 / std::numbers::pi);
};

TEST_F(CompareStrips, ADiagramEqualsItself) {
    const Diagram d = strips({0.25, 0.75});
    const DiagramDifference same = compare_diagrams(surface_, d, d);
    EXPECT_NEAR(same.cell_radius, radius_of_two_, 1e-12);
    EXPECT_EQ(same.frechet.sum, 0);
    EXPECT_EQ(same.frechet.delta, 0);
    EXPECT_EQ(same.frechet.matched_loops, 2u);
    EXPECT_EQ(same.frechet.unmatched_loops, 0u);
    EXPECT_EQ(same.wrong_label_area, 0);
    EXPECT_NEAR(same.hausdorff, 0, 1e-15);
}

TEST_F(CompareStrips, AMovedBisectorIsMeasured) {
    // The bisector moves from 0.5 to 0.55; both cells' loops by as much.
    const DiagramDifference moved =
        compare_diagrams(surface_, strips({0.25, 0.75}), strips({0.25, 0.85}));
    EXPECT_NEAR(moved.frechet.largest, 0.05, 2 * moved.frechet.spacing);
    EXPECT_NEAR(moved.frechet.sum, 0.1, 4 * moved.frechet.spacing);
    EXPECT_GE(moved.frechet.largest, 0.05 - 1e-9);
    EXPECT_NEAR(moved.frechet.delta, 1 - std::exp(-moved.frechet.sum / radius_of_two_ / 100),
                1e-12);
    EXPECT_NEAR(moved.wrong_label_area, 0.05, 4e-3);
    EXPECT_NEAR(moved.hausdorff, 0.05, 1e-9);
}

TEST_F(CompareStrips, FinerSpacingComesNearer) {
    const Diagram a = strips({0.25, 0.75}), b = strips({0.25, 0.85});
    const auto excess = [&](double spacing) {
        return compare_diagrams(surface_, a, b, {.spacing = spacing}).frechet.largest - 0.05;
    };
    EXPECT_LE(excess(0.1), 0.1 * radius_of_two_);
    EXPECT_LE(excess(0.003), 0.003 * radius_of_two_);
}

TEST_F(CompareStrips, AnUnmatchedLoopIsChargedItsDiameter) {
    // The third site repeats the first one and owns nothing, or it has [0.375, 0.625].
    const Diagram without = strips({0.25, 0.75, 0.25}), with = strips({0.25, 0.75, 0.5});
    const double diagonal = std::hypot(1, 0.25);
    for (const bool is_first : {false, true}) {
        const FrechetError error =
            compare_diagrams(surface_, is_first ? with : without, is_first ? without : with)
                .frechet;
        EXPECT_EQ(error.matched_loops, 2u);
        EXPECT_EQ(error.unmatched_loops, 1u);
        EXPECT_NEAR(error.largest, diagonal, error.spacing);
        EXPECT_NEAR(error.sum, diagonal + 2 * 0.125, 5 * error.spacing);
    }
}

TEST_F(CompareStrips, DiagramsWithAndWithoutBisectorsAreInfinitelyFar) {
    const Diagram one = strips({0.25, 0.25}), two = strips({0.25, 0.75});
    EXPECT_EQ(compare_diagrams(surface_, one, two).hausdorff, INFINITY);
    EXPECT_EQ(compare_diagrams(surface_, one, one).hausdorff, 0);
    EXPECT_NEAR(compare_diagrams(surface_, one, two).wrong_label_area, 0.5, 1e-2);
}

TEST_F(CompareStrips, WhatDoesNotFitIsRefused) {
    const Diagram two = strips({0.25, 0.75}), three = strips({0.25, 0.75, 0.5});
    EXPECT_THROW((void)compare_diagrams(surface_, two, three), InvalidInput);
    const Surface other = build_surface(shapes::grid(4).view());
    EXPECT_THROW((void)compare_diagrams(other, two, two), InvalidInput);
    EXPECT_THROW((void)compare_diagrams(surface_, two, two, {.spacing = 0}), InvalidOption);
    EXPECT_THROW((void)compare_diagrams(surface_, two, two, {.c = NAN}), InvalidOption);
    EXPECT_THROW((void)compare_diagrams(surface_, two, two, {.area_samples = 0}), InvalidOption);
}

TEST_F(CompareStrips, BisectorsOfOtherSitesAreFoundWrong) {
    // Points (0.5, y) seen from sites at 0.25 and 0.85.
    const Diagram right = strips({0.25, 0.85}), wrong = strips({0.25, 0.75});
    const std::array diagrams{&right, &wrong};
    const auto errors = exact_bisector_errors(surface_, sites_at({0.25, 0.85}), diagrams);
    ASSERT_EQ(errors.size(), 2u);
    EXPECT_NEAR(errors[0].max, 0, 1e-6);
    const double at_middle = 0.35 - 0.25;
    const double at_end = std::hypot(0.35, 0.5) - std::hypot(0.25, 0.5);
    EXPECT_NEAR(errors[1].max, at_middle / radius_of_two_, 1e-3);
    EXPECT_GT(errors[1].mean, at_end / radius_of_two_);
    EXPECT_LT(errors[1].mean, errors[1].p95);
    EXPECT_LE(errors[1].p95, errors[1].max);
    const auto few =
        exact_bisector_errors(surface_, sites_at({0.25, 0.85}), diagrams, {.max_points = 3});
    EXPECT_GE(few[1].num_points, 2u);
    EXPECT_LE(few[1].num_points, 3u);
}

TEST(CompareDiagrams, LoopsKeepTheCellOnTheirLeft) {
    const Surface surface = build_surface(shapes::grid(6).view());
    const auto sites = points::scattered(surface, 8, 3);
    const Diagram diagram =
        build_diagram(surface, sites, propagate(surface, sites, {.max_error = 0}));
    const LoopCurves curves = loop_curves(surface, diagram);
    ASSERT_EQ(curves.cell_loops.size(), 9u);
    for (Index s = 0; s < 8; ++s) {
        double area = 0;  // Shoelace: counter-clockwise is positive.
        for (Index l = curves.cell_loops[s]; l < curves.cell_loops[s + 1]; ++l) {
            const auto& loop = curves.loops[l];
            for (std::size_t i = 0; i < loop.size(); ++i) {
                area += loop[i].cross(loop[(i + 1) % loop.size()]).z() / 2;
            }
        }
        EXPECT_NEAR(area, diagram.cell_area[s], 1e-9) << s;
    }
}

TEST(CompareDiagrams, SmoothSurfacesGiveTheSameForAnyThreadsAndBothWays) {
    const Surface surface = build_surface(shapes::jitter(shapes::torus(40, 20), 0.01, 2).view());
    const auto sites = points::scattered(surface, 25, 3);
    const auto build = [&](const PropagationOptions& options) {
        return build_diagram(surface, sites, propagate(surface, sites, options));
    };
    const Diagram exact = build({.max_error = 0});
    const Diagram coarse = build({.engine = Engine::Steiner, .steiner_points = 2});
    const Diagram fine = build({.engine = Engine::Steiner, .steiner_points = 12});
    const auto one = compare_diagrams(surface, coarse, exact, {.num_threads = 1});
    const auto many = compare_diagrams(surface, coarse, exact, {.num_threads = 8});
    EXPECT_EQ(one.frechet.sum, many.frechet.sum);
    EXPECT_EQ(one.hausdorff, many.hausdorff);
    const auto back = compare_diagrams(surface, exact, coarse);
    EXPECT_EQ(one.wrong_label_area, back.wrong_label_area);
    EXPECT_EQ(one.hausdorff, back.hausdorff);
    EXPECT_NEAR(one.frechet.sum, back.frechet.sum, 25 * one.frechet.spacing);
    // Largest loop distance against that of the networks: loops are matched as wholes.
    EXPECT_GE(one.frechet.largest, one.hausdorff - one.frechet.spacing);
    const auto better = compare_diagrams(surface, fine, exact);
    EXPECT_LT(better.frechet.sum, one.frechet.sum / 3);
    EXPECT_LT(better.wrong_label_area, one.wrong_label_area / 3);
    EXPECT_LT(better.hausdorff, one.hausdorff);
}

}  // namespace
