// The steps of finding creases, each on a mesh whose angles are given or known.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "remesh/curves/crease_chains.h"
#include "support/parts.h"
#include "support/shapes.h"

using namespace agvd;
using namespace remesh::detail;

namespace {

constexpr double strong = 90 * degree, weak = 30 * degree;

// A grid of 20 x 20 quads of side .05, and lines on it.
class Drawing {
public:
    Drawing() : surface(build_surface(shapes::grid(20).view())), set(surface) {
        angles.assign(surface.num_edges(), 0);
    }
    Drawing(const Drawing&) = delete;

    // Along x or y, from one point to another; edges in the set are strong, others weak.
    void line(double x0, double y0, double x1, double y1, bool is_in_set = true) {
        each_edge(x0, y0, x1, y1, [&](Index e) {
            angles[e] = is_in_set ? strong : weak;
            if (is_in_set) set.add(e);
        });
    }
    [[nodiscard]] bool has(double x0, double y0, double x1, double y1) const {
        bool all = true;
        each_edge(x0, y0, x1, y1, [&](Index e) { all = all && set.has(e); });
        return all;
    }
    [[nodiscard]] double length() const {
        double sum = 0;
        for (Index e = 0; e < surface.num_edges(); ++e) sum += set.has(e) ? surface.length[e] : 0;
        return sum;
    }
    void prune_with(const PruningRules& rules) {
        prune(set, std::vector<double>(surface.num_edges(), 1), rules, poller);
    }

    Surface surface;
    CreaseSet set;
    std::vector<double> angles;
    Poller poller;

private:
    void each_edge(double x0, double y0, double x1, double y1,
                   const std::function<void(Index)>& use) const {
        int count = 0;
        for (Index e = 0; e < surface.num_edges(); ++e) {
            const Index h = surface.edge_half[e];
            const Vec3& a = surface.mesh.positions[surface.tail(h)];
            const Vec3& b = surface.mesh.positions[surface.head(h)];
            const auto is_on = [&](const Vec3& p) {
                return p.x() > x0 - 1e-9 && p.x() < x1 + 1e-9 && p.y() > y0 - 1e-9 &&
                       p.y() < y1 + 1e-9;
            };
            if (!is_on(a) || !is_on(b)) continue;
            use(e);
            ++count;
        }
        EXPECT_EQ(count, std::lround((x1 - x0 + y1 - y0) / 0.05));
    }
};

}  // namespace

TEST(CreaseSet, NextPassesAllEdgesOfTheSet) {
    const Surface surface = build_surface(shapes::grid(20).view());
    CreaseSet set(surface);
    EXPECT_EQ(set.next(0), surface.num_edges());
    const std::vector<Index> edges{0, 7, 8, 400, surface.num_edges() - 1};
    for (const Index e : edges) set.add(e);
    std::vector<Index> found;
    for (Index e = set.next(0); e < surface.num_edges(); e = set.next(e + 1)) found.push_back(e);
    EXPECT_EQ(found, edges);
    EXPECT_EQ(set.next(surface.num_edges()), surface.num_edges());
}

TEST(CloseGaps, WeakEdgesCloseAGapUpToItsLimit) {
    for (const double most_gap : {0.25, 0.15}) {
        Drawing drawing;
        drawing.line(0.1, 0.5, 0.4, 0.5);
        drawing.line(0.4, 0.5, 0.6, 0.5, false);
        drawing.line(0.6, 0.5, 0.9, 0.5);
        close_gaps(drawing.set, drawing.angles, {.least_angle = weak, .most_gap = most_gap},
                   drawing.poller);
        EXPECT_EQ(drawing.has(0.4, 0.5, 0.6, 0.5), most_gap > 0.2);
        EXPECT_NEAR(drawing.length(), most_gap > 0.2 ? 0.8 : 0.6, 1e-12);
    }
}

TEST(CloseGaps, EdgesThatAreTooWeakAndGapsLongerThanTheirChainStayOpen) {
    Drawing drawing;
    drawing.line(0.1, 0.5, 0.4, 0.5);
    drawing.line(0.4, 0.5, 0.5, 0.5, false);
    drawing.line(0.5, 0.5, 0.9, 0.5);
    close_gaps(drawing.set, drawing.angles, {.least_angle = 1.01 * weak, .most_gap = 1},
               drawing.poller);
    EXPECT_NEAR(drawing.length(), 0.7, 1e-12);

    Drawing dots;
    dots.line(0.2, 0.5, 0.3, 0.5);
    dots.line(0.3, 0.5, 0.5, 0.5, false);
    dots.line(0.5, 0.5, 0.6, 0.5);
    close_gaps(dots.set, dots.angles, {.least_angle = weak, .most_gap = 1}, dots.poller);
    EXPECT_NEAR(dots.length(), 0.2, 1e-12);
}

TEST(CloseGaps, ChainsRunIntoOthersAndIntoTheBoundaryButNotBack) {
    Drawing drawing;
    drawing.angles.assign(drawing.surface.num_edges(), weak);
    drawing.line(0.5, 0.1, 0.5, 0.9);
    drawing.line(0.15, 0.5, 0.35, 0.5);  // Ahead: the line above at 0.15, the boundary at 0.15.
    close_gaps(drawing.set, drawing.angles, {.least_angle = weak, .most_gap = 0.18},
               drawing.poller);
    EXPECT_TRUE(drawing.has(0, 0.5, 0.5, 0.5));
    EXPECT_TRUE(drawing.has(0.5, 0, 0.5, 1));
    EXPECT_NEAR(drawing.length(), 1.5, 1e-12);
}

TEST(CloseGaps, RingThatLacksAnEdgeIsClosed) {
    Drawing drawing;
    drawing.line(0.3, 0.3, 0.7, 0.3);
    drawing.line(0.3, 0.7, 0.7, 0.7);
    drawing.line(0.3, 0.3, 0.3, 0.7);
    drawing.line(0.7, 0.3, 0.7, 0.45);
    drawing.line(0.7, 0.45, 0.7, 0.55, false);
    drawing.line(0.7, 0.55, 0.7, 0.7);
    close_gaps(drawing.set, drawing.angles, {.least_angle = weak, .most_gap = 0.2}, drawing.poller);
    EXPECT_NEAR(drawing.length(), 1.6, 1e-12);
}

TEST(ExtendEnds, GoOnStraightByAtMostTheirOwnLength) {
    Drawing drawing;
    drawing.line(0.1, 0.5, 0.3, 0.5);
    drawing.line(0.3, 0.5, 0.8, 0.5, false);
    drawing.line(0.5, 0.5, 0.5, 0.9, false);
    extend_ends(drawing.set, drawing.angles, {.least_angle = weak}, drawing.poller);
    EXPECT_TRUE(drawing.has(0.1, 0.5, 0.45, 0.5));
    EXPECT_LE(drawing.length(), 0.4 + 1e-9);
}

TEST(ExtendEnds, DoNotTurnOffAtRightAngles) {
    Drawing drawing;
    drawing.line(0.1, 0.5, 0.5, 0.5);
    drawing.line(0.5, 0.5, 0.5, 0.9, false);
    extend_ends(drawing.set, drawing.angles, {.least_angle = weak}, drawing.poller);
    EXPECT_NEAR(drawing.length(), 0.4, 1e-12);
}

TEST(Prune, SpursGoAndWhatTheyBranchedFromIsOneChain) {
    Drawing drawing;
    drawing.line(0, 0.5, 1, 0.5);
    drawing.line(0.5, 0.5, 0.5, 0.6);
    drawing.line(0.7, 0.3, 0.7, 0.5);
    // The pieces between spurs are shorter than an island may be; the whole is not.
    drawing.prune_with({.least_spur = 0.15, .least_island = 0.9, .least_network = 0});
    EXPECT_FALSE(drawing.has(0.5, 0.5, 0.5, 0.6));
    EXPECT_TRUE(drawing.has(0.7, 0.3, 0.7, 0.5));
    EXPECT_TRUE(drawing.has(0, 0.5, 1, 0.5));
    EXPECT_NEAR(drawing.length(), 1.2, 1e-12);
    EXPECT_EQ(chains_of(drawing.set, drawing.poller).size(), 3u);
}

TEST(Prune, CrossOfSpursKeepsItsLongestLine) {
    Drawing drawing;
    drawing.line(0.2, 0.5, 0.8, 0.5);
    drawing.line(0.5, 0.4, 0.5, 0.6);
    drawing.prune_with({.least_spur = 0.35, .least_island = 0.5});
    EXPECT_TRUE(drawing.has(0.2, 0.5, 0.8, 0.5));
    EXPECT_NEAR(drawing.length(), 0.6, 1e-12);
}

TEST(Prune, IslandsAndRingsAreJudgedAsAWhole) {
    for (const double least : {0.35, 0.45}) {
        Drawing drawing;
        drawing.line(0.1, 0.9, 0.5, 0.9);  // An island of .4
        drawing.line(0.3, 0.3, 0.4, 0.3);  // and a ring of .4.
        drawing.line(0.3, 0.4, 0.4, 0.4);
        drawing.line(0.3, 0.3, 0.3, 0.4);
        drawing.line(0.4, 0.3, 0.4, 0.4);
        drawing.prune_with({.least_island = least, .least_network = least, .short_chain = 0.1});
        EXPECT_NEAR(drawing.length(), least < 0.4 ? 0.8 : 0, 1e-12);
    }
}

TEST(Prune, RingsAreSpursOnlyWhereTheyHangOnOthers) {
    for (const bool hangs : {false, true}) {
        Drawing drawing;
        drawing.line(0.3, 0.3, 0.4, 0.3);
        drawing.line(0.3, 0.4, 0.4, 0.4);
        drawing.line(0.3, 0.3, 0.3, 0.4);
        drawing.line(0.4, 0.3, 0.4, 0.4);
        if (hangs) drawing.line(0, 0.3, 0.3, 0.3);
        if (hangs) drawing.line(0.3, 0, 0.3, 0.3);
        drawing.prune_with({.least_spur = 0.5});
        EXPECT_NEAR(drawing.length(), hangs ? 0.6 : 0.4, 1e-12);
    }
}

TEST(Prune, NetworksOfShortChainsGoThoseWithAFewStay) {
    Drawing drawing;
    for (int i = 0; i <= 4; ++i) {  // 40 chains of .1.
        drawing.line(0.1, 0.1 + 0.1 * i, 0.5, 0.1 + 0.1 * i);
        drawing.line(0.1 + 0.1 * i, 0.1, 0.1 + 0.1 * i, 0.5);
    }
    drawing.line(0.6, 0.7, 1, 0.7);  // A thin wall: two chains of .4 and one of .1.
    drawing.line(0.6, 0.8, 1, 0.8);
    drawing.line(0.6, 0.7, 0.6, 0.8);
    drawing.line(0.7, 0.7, 0.7, 0.8);
    drawing.prune_with({.short_chain = 0.3, .least_density = 0.5});
    EXPECT_NEAR(drawing.length(), 1.0, 1e-12);
}

TEST(EdgeAngles, AreThoseOfTheFacesAndZeroOnTheBoundary) {
    const Surface surface = build_surface(shapes::cube().view());
    Poller poller;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const double angle = edge_angles(surface, 0, 1, poller)[e];
        EXPECT_NEAR(angle, surface.length[e] < 1.1 ? 90 * degree : 0, 1e-12);
    }
    const Surface open = build_surface(shapes::grid(1).view());
    for (const double angle : edge_angles(open, 0, 1, poller)) EXPECT_EQ(angle, 0);
}

TEST(EdgeAngles, NeedleOfAnyDirectionTakesThatOfItsNeighbours) {
    // Two squares' halves meet in a needle from (0, 0, 0) to (1, 0, 0), whose third corner is off
    // the plane by as much as it is wide.
    for (const double side : {1e-7, -1e-7}) {
        const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0.5, 1e-7, side}, {0.5, 1, 0}, {0.5, 0, 1}},
                                {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}, {1, 0, 4}}};
        const Surface surface = build_surface(mesh.view());
        Poller poller;
        const auto largest = [&](double thin) {
            double sum = 0;
            const auto angles = edge_angles(surface, thin, 1, poller);
            for (Index e = 0; e < surface.num_edges(); ++e) {
                sum += angles[e] > 20 * degree ? surface.length[e] : 0;
            }
            return sum;
        };
        EXPECT_NEAR(largest(0), 2, 1e-6);  // 45 and 45 or 45 and 135 degrees.
        EXPECT_NEAR(largest(1e-5), 1, 1e-6);
    }
}

TEST(SurroundingTurn, IsTheRootOfTheSquaresWithinReach) {
    // Folds of 20 degrees at y = -.1 and .1, beside a flat line at y = 0.
    const double rise = std::tan(20 * degree);
    TriangleMesh mesh = parts::folded_plate(160, 20, 0.5, [](double) { return 0; });
    for (Vec3& p : mesh.positions) p.z() = rise * std::max(0., std::abs(p.y()) - 0.1);
    const Surface surface = build_surface(mesh.view());
    Poller poller;
    const std::vector<double> angles = edge_angles(surface, 0, 1, poller);
    CreaseSet set(surface);
    Index middle = no_index;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        const Vec3& a = mesh.positions[surface.tail(h)];
        const Vec3& b = mesh.positions[surface.head(h)];
        if (std::abs(a.y()) > 1e-9 || std::abs(b.y()) > 1e-9) continue;
        set.add(e);
        if (std::min(a.x(), b.x()) < 0 && std::max(a.x(), b.x()) >= 0) middle = e;
    }
    ASSERT_NE(middle, no_index);
    const auto at = [&](double reach) {
        return surrounding_turn(set, angles, reach, poller)[middle] / degree;
    };
    EXPECT_NEAR(at(0.3), 20 * std::numbers::sqrt2, 0.1);
    EXPECT_EQ(at(0.07), 0);
}
