// Sites of curves, drawn along them by slopes made by hand.
#include "remesh/sites/relaxation.h"

#include <gtest/gtest.h>

#include "support/flag_edges.h"
#include "support/parts.h"

using agvd::Index;
using agvd::Surface;
using agvd::Vec3;
using remesh::Curve;
using remesh::CurveSites;
using remesh::detail::CurveMotion;
using remesh::detail::CvtEnergy;

namespace {

constexpr double spacing = .2;

// The unit cube with five intervals on each edge.
struct Cube {
    Cube() : surface(agvd::build_surface(parts::box({1, 1, 1}, 4).view())) {
        const std::vector<std::uint8_t> flags = flag_sharp_edges(surface);
        network = remesh::find_network(surface, flags, spacing);
        cut = remesh::cut_surface(surface, flags);
        const std::vector<Index> intervals(12, 5);
        sites = remesh::curve_sites_at(
            network, cut, remesh::even_positions(cut.surface(), network, spacing, intervals));
        cells.assign(sites.sites.size(), {Vec3::Zero(), Vec3::Zero(), 1, 1});
    }

    // All copies of a curve's sites get a slope along the curve.
    void pull(Index curve, double slope) {
        for (Index g = sites.first_of_curve[curve]; g < sites.first_of_curve[curve + 1]; ++g) {
            const Vec3 tangent = tangent_of_curve(surface, network.curves[curve], sites.along[g]);
            for (Index i = sites.first_copy[g]; i < sites.first_copy[g + 1]; ++i) {
                cells[i].slope = slope * tangent;
            }
        }
    }

    Surface surface;
    remesh::CurveNetwork network;
    remesh::CutSurface cut;
    CurveSites sites;
    std::vector<CvtEnergy::Cell> cells;
};

}  // namespace

TEST(CurveMotion, SitesGoDownTheSlopeOfAllTheirCopies) {
    Cube cube;
    const Index curve = 5, group = cube.sites.first_of_curve[curve] + 1;
    const Vec3 tangent = tangent_of_curve(cube.surface, cube.network.curves[curve], .4);
    // Across the curve there is no way. The masses are 1 and 3, the slopes along .08 and -.16.
    const Index first = cube.sites.first_copy[group];
    const Vec3 across = tangent.cross(Vec3(.3, .5, .7));
    cube.cells[first].slope = .08 * tangent + across;
    cube.cells[first + 1].slope = -.16 * tangent - 2 * across;
    cube.cells[first + 1].mass = 3;
    CurveMotion motion(cube.surface, cube.network, cube.sites);
    EXPECT_EQ(motion.measure(cube.cells), 0);  // Nothing has moved.
    motion.step(0.5, 0);
    // Newton's step is (.08 / 2) / 4 ahead.
    for (Index g = 0; g < cube.sites.num_groups(); ++g) {
        const double move = g == group ? .005 : 0;
        EXPECT_NEAR(motion.sites().along[g], cube.sites.along[g] + move, 1e-12) << g;
    }
    const auto& moved = motion.sites();
    const Vec3 expected =
        position(cube.cut.surface().mesh.view(), cube.sites.sites[first]) + .005 * tangent;
    for (Index copy = first; copy < first + 2; ++copy) {
        EXPECT_LT((position(cube.cut.surface().mesh.view(), moved.sites[copy]) - expected).norm(),
                  1e-12);
        EXPECT_EQ(motion.copies_with(copy), std::pair(first, first + 2));
    }
    // Half the slope, -.04, times the move; then the move goes on by itself.
    EXPECT_NEAR(motion.measure(cube.cells), -.04 * .005, 1e-12);
    motion.step(0, 0.5);
    EXPECT_NEAR(motion.sites().along[group], cube.sites.along[group] + .0075, 1e-12);
    motion.take_back(first + 1);
    EXPECT_NEAR(motion.sites().along[group], cube.sites.along[group] + .005, 1e-12);
}

TEST(CurveMotion, NodesStay) {
    Cube cube;
    for (auto& cell : cube.cells) cell.slope = Vec3(1, 2, 3);
    CurveMotion motion(cube.surface, cube.network, cube.sites);
    (void)motion.measure(cube.cells);
    motion.step(1, 0);
    for (Index i = 0; i < cube.sites.first_copy[cube.sites.num_nodes()]; ++i) {
        EXPECT_EQ(motion.sites().sites[i], cube.sites.sites[i]);
        motion.take_back(i);
        EXPECT_EQ(motion.sites().sites[i], cube.sites.sites[i]);
    }
    EXPECT_NE(motion.sites().along, cube.sites.along);
}

TEST(CurveMotion, NeighboursDoNotMeet) {
    Cube cube;
    CurveMotion motion(cube.surface, cube.network, cube.sites);
    cube.pull(2, -100);
    cube.pull(7, 100);
    for (int i = 0; i < 40; ++i) {
        (void)motion.measure(cube.cells);
        motion.step(1, 0.5);
    }
    for (Index c = 0; c < 12; ++c) {
        double before = 0;
        for (Index g = cube.sites.first_of_curve[c]; g < cube.sites.first_of_curve[c + 1]; ++g) {
            EXPECT_GT(motion.sites().along[g] - before, 0.49 * spacing) << c;
            before = motion.sites().along[g];
        }
        EXPECT_GT(1 - before, 0.49 * spacing);
    }
    const auto& along = motion.sites().along;
    EXPECT_GT(along[cube.sites.first_of_curve[3] - 1], .85);
    EXPECT_LT(along[cube.sites.first_of_curve[7]], .15);
    EXPECT_EQ(along[cube.sites.first_of_curve[5]], .2);
}

TEST(CurveMotion, ClosedCurvesGoRound) {
    const Surface surface = agvd::build_surface(parts::capped_cylinder(32, 4).view());
    const std::vector<std::uint8_t> flags = flag_sharp_edges(surface);
    const auto network = remesh::find_network(surface, flags, .2);
    const auto cut = remesh::cut_surface(surface, flags);
    const auto sites = remesh::curve_sites_at(
        network, cut,
        remesh::even_positions(cut.surface(), network, .2, std::vector<Index>(2, 16)));
    CurveMotion motion(surface, network, sites);
    for (int i = 0; i < 60; ++i) {
        std::vector<CvtEnergy::Cell> cells(sites.sites.size(), {Vec3::Zero(), Vec3::Zero(), 1, 1});
        for (Index g = 0; g < 16; ++g) {
            const Vec3 tangent =
                tangent_of_curve(surface, network.curves[0], motion.sites().along[g]);
            for (Index k = sites.first_copy[g]; k < sites.first_copy[g + 1]; ++k) {
                cells[k].slope = -.2 * tangent;
            }
        }
        (void)motion.measure(cells);
        motion.step(1, 0);
    }
    // A tenth each time: past the whole length.
    for (Index g = 0; g < 16; ++g) {
        EXPECT_GT(motion.sites().along[g], sites.along[g] + 0.4);
        EXPECT_NEAR(motion.sites().along[(g + 1) % 16] - motion.sites().along[g],
                    network.curves[0].length() / 16 - (g == 15 ? network.curves[0].length() : 0),
                    1e-9);
    }
    EXPECT_EQ(motion.sites().along[20], sites.along[20]);
}
