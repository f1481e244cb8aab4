#include "paper/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "paper/compare_diagrams.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// Two sites on the middle line of the unit square, at x = 0.25 and 0.75.
struct TwoSites {
    Surface surface = build_surface(shapes::grid(4).view());
    std::vector<SurfacePoint> sites{point_at(surface, 7), point_at(surface, 17)};
    Propagation propagation = propagate(surface, sites);

    // A straight Voronoi edge through the square at x = 0.5 + shift, shift in (0, 0.25).
    [[nodiscard]] Diagram straight_edge(double shift) const {
        Diagram diagram;
        diagram.num_sites = 2;
        for (Index j = 0; j < 4; ++j) {
            // Quad (2, j): face 0 has the lower side and, from its third to its first corner, the
            // diagonal.
            const FaceId face(2 * (2 * 4 + j));
            diagram.points.push_back({face, {1 - 4 * shift, 4 * shift, 0}});
            diagram.points.push_back({face, {1 - 4 * shift, 0, 4 * shift}});
        }
        diagram.edges = {{SiteId(0), SiteId(1), 0, 1}};
        diagram.edge_points = {0, 8};
        diagram.point_distance.assign(8, 0.3);
        return diagram;
    }

    [[nodiscard]] DiagramError compare(const Diagram& diagram) const {
        const Approximation approximation{propagation, diagram};
        return compare_with_exact(surface, sites, {&approximation, 1}, {.num_threads = 1})[0];
    }
};

}  // namespace

TEST(Compare, TheTrueBisectorHasNoError) {
    const TwoSites two;
    const DiagramError error = two.compare(two.straight_edge(0));
    EXPECT_EQ(error.bisectors.num_points, 15u);  // Eight and the seven middles.
    EXPECT_NEAR(error.bisectors.max, 0, 1e-14);
    EXPECT_LT(error.wrong_label_area, 1e-3);
}

TEST(Compare, AMovedBisectorErrsByItsDistances) {
    const TwoSites two;
    const double shift = 0.1;
    const DiagramError error = two.compare(two.straight_edge(shift));
    const double radius = std::sqrt(1 / (2 * std::numbers::pi));
    double mean = 0, worst = 0;
    std::vector<double> heights;
    for (int j = 0; j < 4; ++j) {
        heights.insert(heights.end(), {j / 4.0, j / 4.0 + shift / 2, j / 4.0 + shift});
        if (j < 3) heights.push_back((j / 4.0 + shift + (j + 1) / 4.0) / 2);
    }
    for (const double y : heights) {
        const double e =
            (std::hypot(0.25 + shift, y - 0.5) - std::hypot(0.25 - shift, y - 0.5)) / radius;
        mean += e / static_cast<double>(heights.size());
        worst = std::max(worst, e);
    }
    EXPECT_NEAR(error.bisectors.mean, mean, 1e-13);
    EXPECT_NEAR(error.bisectors.max, worst, 1e-13);
    EXPECT_LT(error.bisectors.p95, worst);
}

TEST(Compare, WrongLabelsAreCountedByArea) {
    TwoSites two;
    two.propagation.mixed_faces.clear();
    two.propagation.vertex_site.assign(two.surface.num_vertices(), SiteId(1));
    EXPECT_NEAR(two.compare(two.straight_edge(0)).wrong_label_area, 0.5, 0.01);
}

// At (0, 0.5) and (1, 0.5), a quarter from one site and three quarters from the other.
TEST(Compare, LabelsErrByHowMuchFartherTheirSitesAre) {
    const TwoSites two;
    const std::vector<SurfacePoint> points{point_at(two.surface, 2), point_at(two.surface, 22)};
    const std::vector<std::vector<SiteId>> labels{
        {SiteId(0), SiteId(1)}, {SiteId(1), SiteId(1)}, {SiteId(), SiteId(1)}};
    const auto errors = compare_labels(two.surface, two.sites, points, labels);
    EXPECT_EQ(errors[0].wrong, 0);
    EXPECT_EQ(errors[0].largest, 0);
    EXPECT_EQ(errors[1].wrong, 0.5);
    EXPECT_NEAR(errors[1].largest, 0.5, 1e-14);
    EXPECT_EQ(errors[2].wrong, 0.5);
    EXPECT_TRUE(std::isinf(errors[2].largest));
}

// Both sites at one place: every point ties, so both labels are right everywhere.
TEST(Compare, TiedSitesAreBothRight) {
    TwoSites two;
    two.sites[1] = two.sites[0];
    two.propagation = propagate(two.surface, two.sites);
    two.propagation.vertex_site.assign(two.surface.num_vertices(), SiteId(1));
    EXPECT_EQ(two.compare(Diagram()).wrong_label_area, 0);
}

TEST(Compare, DistancesBelowTheExactOnesShow) {
    TwoSites two;
    EXPECT_GE(two.compare(two.straight_edge(0)).min_relative_distance, -1e-15);
    two.propagation.vertex_distance[0] *= 0.9;
    const DiagramError error = two.compare(two.straight_edge(0));
    EXPECT_NEAR(error.min_relative_distance, -0.1, 1e-3);
}

TEST(Compare, AVertexTheExactSearchDoesNotReachIsAnInfiniteError) {
    TwoSites two;
    two.surface = build_surface(shapes::join(shapes::grid(4), shapes::tetrahedron()).view());
    two.propagation = propagate(two.surface, two.sites);
    const Diagram diagram = two.straight_edge(0);
    EXPECT_TRUE(std::isfinite(two.compare(diagram).mean_relative_distance));
    two.propagation.vertex_distance.back() = 1;
    EXPECT_TRUE(std::isinf(two.compare(diagram).min_relative_distance));
}

// The window engine on the surroundings of each site, and CGAL on as much as it needs.
TEST(Compare, BothWaysToExactDistancesMeasureTheSameErrors) {
    const Surface surface = build_surface(shapes::jitter(shapes::torus(40, 20), 0.02, 4).view());
    const auto sites = points::scattered(surface, 20, 5);
    for (const Engine engine : {Engine::Steiner, Engine::Window}) {
        const Propagation propagation = propagate(surface, sites, {.engine = engine});
        const Diagram diagram = build_diagram(surface, sites, propagation);
        const Approximation approximation{propagation, diagram};
        const auto by_cgal = compare_with_exact(surface, sites, {&approximation, 1})[0];
        const Diagram* const pointer = &diagram;
        const auto by_windows = exact_bisector_errors(surface, sites, {&pointer, 1})[0];
        EXPECT_EQ(by_windows.num_points, by_cgal.bisectors.num_points);
        EXPECT_NEAR(by_windows.mean, by_cgal.bisectors.mean, 1e-6);
        EXPECT_NEAR(by_windows.p95, by_cgal.bisectors.p95, 1e-6);
        EXPECT_NEAR(by_windows.max, by_cgal.bisectors.max, 1e-6);
    }
}
