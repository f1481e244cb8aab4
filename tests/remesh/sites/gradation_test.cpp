#include "remesh/sites/target_lengths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "agvd/core/random.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Surface;
using remesh::Paths;

namespace {

using Pairs = std::vector<std::pair<Index, Index>>;

std::vector<double> limited(const Surface& surface, std::vector<double> length, double slope,
                            const Pairs& joined = {}, Paths paths = Paths::Lines) {
    agvd::Ticker ticker;
    remesh::limit_growth(surface, joined, slope, paths, length, ticker);
    return length;
}

std::vector<double> random_lengths(Index count, std::uint64_t seed) {
    std::vector<double> length;
    for (Index v = 0; v < count; ++v) length.push_back(0.01 + agvd::random_unit(seed, 0, v));
    return length;
}

}  // namespace

TEST(Gradation, IsTheLargestFieldThatGrowsNoFaster) {
    for (const agvd::TriangleMesh& mesh : {shapes::torus(30, 15), shapes::grid(12)}) {
        const Surface surface = agvd::build_surface(mesh.view());
        for (const double slope : {0.1, 0.5, 3.0}) {
            const std::vector<double> before = random_lengths(surface.num_vertices(), 7);
            const std::vector<double> after = limited(surface, before, slope, {}, Paths::Edges);
            // The least that any edge allows at each vertex.
            std::vector<double> most(before);
            for (Index e = 0; e < surface.num_edges(); ++e) {
                const Index h = surface.edge_half[e];
                const Index a = surface.tail(h), b = surface.head(h);
                const double rise = slope * surface.length[e];
                EXPECT_LE(std::abs(after[a] - after[b]), rise * (1 + 1e-12));
                most[a] = std::min(most[a], after[b] + rise);
                most[b] = std::min(most[b], after[a] + rise);
            }
            // So each length is as before, or as long as a neighbour allows.
            EXPECT_EQ(most, after);
            EXPECT_NE(before, after);
            EXPECT_EQ(limited(surface, after, slope, {}, Paths::Edges), after);
            const std::vector<double> by_lines = limited(surface, before, slope);
            for (Index v = 0; v < most.size(); ++v) EXPECT_LE(by_lines[v], after[v]);
            EXPECT_EQ(limited(surface, by_lines, slope), by_lines);
        }
    }
}

TEST(Gradation, OneShortEdgeSpreadsAsACone) {
    const Surface surface = agvd::build_surface(shapes::grid(10).view());
    std::vector<double> length(surface.num_vertices(), 5);
    length[0] = 0.2;
    const std::vector<double> after = limited(surface, length, 0.3);
    for (Index v = 0; v < after.size(); ++v) {
        const double away = (surface.mesh.positions[v] - surface.mesh.positions[0]).norm();
        EXPECT_GE(after[v], 0.2 + 0.3 * away - 1e-12);
        EXPECT_LE(after[v], 0.2 + 0.3 * 1.1 * away + 1e-12);
    }
}

TEST(Gradation, CopiesOfAVertexGetOneLength) {
    const Surface surface =
        agvd::build_surface(shapes::join(shapes::grid(6), shapes::grid(6)).view());
    const Index half = surface.num_vertices() / 2;
    std::vector<double> length(surface.num_vertices(), 9);
    length[0] = 1;
    const auto apart = limited(surface, length, 0.1);
    EXPECT_EQ(apart[half], 9);
    const auto joined = limited(surface, length, 0.1, {{48, half + 48}});
    EXPECT_EQ(joined[half + 48], joined[48]);
    EXPECT_LT(joined[half + 48], 1.2);
    // It goes on from there.
    EXPECT_GT(joined[half], joined[half + 48]);
    EXPECT_LT(joined[half], 1.5);
}
