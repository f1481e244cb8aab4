// Curves beside a much shorter one get sites that lead up to it.
#include "remesh/curves/curve_sites.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/flag_edges.h"
#include "support/parts.h"

using agvd::Index;
using agvd::Surface;

namespace {

using Places = std::vector<std::vector<double>>;

// A box and its twelve edges.
struct Box {
    explicit Box(const agvd::Vec3& size)
        : surface(agvd::build_surface(parts::box(size, 1).view())),
          network(remesh::find_network(surface, flag_sharp_edges(surface), 1)) {}

    // Divided evenly, and then guarded.
    [[nodiscard]] std::pair<Places, Places> at_spacing(double spacing) const {
        const Places even = remesh::even_positions(
            surface, network, spacing, remesh::curve_intervals(surface, network, spacing));
        Places guarded = even;
        remesh::guard_corners(surface, network, guarded);
        return {even, guarded};
    }

    Surface surface;
    remesh::CurveNetwork network;
};

// The unit cube with the corner at the origin cut off, up to (cut, 0, 0), (0, cut, 0) and
// (0, 0, cut).
agvd::TriangleMesh cube_without_corner(double cut) {
    return {{{cut, 0, 0},
             {0, cut, 0},
             {0, 0, cut},
             {1, 0, 0},
             {0, 1, 0},
             {0, 0, 1},
             {1, 1, 0},
             {0, 1, 1},
             {1, 0, 1},
             {1, 1, 1}},
            {{0, 1, 4},
             {0, 4, 6},
             {0, 6, 3},
             {1, 2, 5},
             {1, 5, 7},
             {1, 7, 4},
             {2, 0, 3},
             {2, 3, 8},
             {2, 8, 5},
             {5, 8, 9},
             {5, 9, 7},
             {3, 6, 9},
             {3, 9, 8},
             {4, 7, 9},
             {4, 9, 6},
             {0, 2, 1}}};
}

}  // namespace

TEST(GuardCorners, IntervalsOfOneLengthStayAsTheyAre) {
    const Box box({1, 1, 1});
    for (const double spacing : {.05, .3, 2.}) {
        const auto [even, guarded] = box.at_spacing(spacing);
        EXPECT_EQ(guarded, even);
    }
}

// Between the large sides of a plate there is a strip, however its edges are divided.
TEST(GuardCorners, StripsStayAsTheyAre) {
    const Box plate({4, 4, .02});
    const auto [even, guarded] = plate.at_spacing(1);
    EXPECT_EQ(guarded, even);
}

TEST(GuardCorners, IntervalsGrowFromAShortCurveOn) {
    const double cut = .01;
    const agvd::TriangleMesh mesh = cube_without_corner(cut);
    const Surface surface = agvd::build_surface(mesh.view());
    const remesh::CurveNetwork network =
        remesh::find_network(surface, flag_sharp_edges(surface), .001);
    ASSERT_EQ(network.curves.size(), 15u);
    const Places even =
        remesh::even_positions(surface, network, .5, remesh::curve_intervals(surface, network, .5));
    Places guarded = even;
    remesh::guard_corners(surface, network, guarded);
    int num_guarded = 0;
    for (Index c = 0; c < network.curves.size(); ++c) {
        if (guarded[c] == even[c]) continue;
        ++num_guarded;
        const double length = network.curves[c].length();
        EXPECT_NEAR(length, 1 - cut, 1e-12);
        EXPECT_TRUE(std::is_sorted(guarded[c].begin(), guarded[c].end()));
        // From the cut on.
        std::vector<double> stops{0};
        stops.insert(stops.end(), guarded[c].begin(), guarded[c].end());
        stops.push_back(length);
        if (stops[1] > length - stops[stops.size() - 2]) {
            for (double& stop : stops) stop = length - stop;
            std::reverse(stops.begin(), stops.end());
        }
        double before = cut * std::sqrt(2);
        for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
            EXPECT_LT((stops[i + 1] - stops[i]) / before, 8);
            before = stops[i + 1] - stops[i];
        }
    }
    EXPECT_EQ(num_guarded, 3);
}

// The other half is left to the other end.
TEST(GuardCorners, ASingleIntervalIsDividedUpToItsMiddle) {
    const double cut = .01, before = cut * std::sqrt(2), length = 1 - cut;
    const Surface surface = agvd::build_surface(cube_without_corner(cut).view());
    const remesh::CurveNetwork network =
        remesh::find_network(surface, flag_sharp_edges(surface), .001);
    Places guarded(network.curves.size());
    remesh::guard_corners(surface, network, guarded);
    int num_guarded = 0;
    for (const std::vector<double>& places : guarded) {
        if (places.empty()) continue;
        ++num_guarded;
        // One place, at the geometric mean of the short interval and the half.
        ASSERT_EQ(places.size(), 1u);
        EXPECT_NEAR(std::min(places[0], length - places[0]), std::sqrt(before * length / 2), 1e-12);
    }
    EXPECT_EQ(num_guarded, 3);
}
