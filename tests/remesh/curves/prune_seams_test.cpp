#include "remesh/curves/crease_chains.h"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "support/shapes.h"

using agvd::Index;
using agvd::Surface;
using agvd::Vec3;

using remesh::prune_seams;

namespace {

using SeamFlags = std::vector<std::uint8_t>;

const Surface& seam_square() {
    static const Surface surface = agvd::build_surface(shapes::grid(40).view());
    return surface;
}

SeamFlags edges_where(const std::function<bool(const Vec3& a, const Vec3& b)>& is_wanted) {
    SeamFlags flags(seam_square().num_edges(), 0);
    for (Index e = 0; e < flags.size(); ++e) {
        const Index h = seam_square().edge_half[e];
        const auto& p = seam_square().mesh.positions;
        if (seam_square().twin[h] == agvd::no_index) continue;
        flags[e] = is_wanted(p[seam_square().tail(h)], p[seam_square().head(h)]) ? 1 : 0;
    }
    return flags;
}

// Edges on the border of the box [low, high] x [0, 1].
SeamFlags strip(double low, double high) {
    return edges_where([&](const Vec3& a, const Vec3& b) {
        const auto is_at = [](const Vec3& p, double x) { return std::abs(p.x() - x) < 1e-9; };
        return (is_at(a, low) && is_at(b, low)) || (is_at(a, high) && is_at(b, high));
    });
}

// On the line y = 1/2 from `begin` to `end`.
SeamFlags seam_line(double begin, double end) {
    return edges_where([&](const Vec3& a, const Vec3& b) {
        const auto is_on = [&](const Vec3& p) {
            return std::abs(p.y() - 0.5) < 1e-9 && p.x() > begin - 1e-9 && p.x() < end + 1e-9;
        };
        return is_on(a) && is_on(b);
    });
}

Index count(const SeamFlags& flags) {
    return std::accumulate(flags.begin(), flags.end(), Index{0});
}

Index left_at(SeamFlags flags, double spacing, const SeamFlags& is_crease = {}) {
    prune_seams(seam_square(), is_crease, spacing, flags);
    return count(flags);
}

}  // namespace

TEST(PruneSeams, ChartsNarrowerThanTwoAndAHalfSpacingsAreLeftOut) {
    const SeamFlags narrow = strip(0.5, 0.6);
    ASSERT_EQ(count(narrow), 80u);
    EXPECT_EQ(left_at(narrow, 0.1 / 2.51), 80u);
    EXPECT_EQ(left_at(narrow, 0.1 / 2.49), 0u);
    // Only what borders on the narrow one goes.
    SeamFlags two = strip(0.1, 0.5);
    const SeamFlags thin = strip(0.9, 0.95);
    for (std::size_t e = 0; e < two.size(); ++e) two[e] |= thin[e];
    ASSERT_EQ(count(two), 160u);
    EXPECT_EQ(left_at(two, 0.05), 80u);
}

TEST(PruneSeams, SpecksGoWithoutTheChartsAroundThem) {
    // Every third square of three columns is a chart of its own.
    SeamFlags flags = seam_line(0, 1);
    for (Index e = 0; e < flags.size(); ++e) {
        const Index h = seam_square().edge_half[e];
        for (const Index side : {h, seam_square().twin[h]}) {
            if (side == agvd::no_index) continue;
            const Index quad = Surface::face(side) / 2;
            const Index twin = seam_square().twin[side];
            const Index other = twin == agvd::no_index ? quad : Surface::face(twin) / 2;
            const Index row = quad % 40;
            const bool is_speck = quad % 3 == 0 && quad / 40 % 12 == 4 && (row < 17 || row > 22);
            if (is_speck && other != quad) flags[e] = 1;
        }
    }
    ASSERT_GT(count(flags), 150u);  // Too much for the two halves.
    EXPECT_EQ(left_at(flags, 0.15), 40u);
}

TEST(PruneSeams, ShortChainsWithAFreeEndAreLeftOut) {
    const SeamFlags slit = seam_line(0.3, 0.6);
    ASSERT_EQ(count(slit), 12u);
    EXPECT_EQ(left_at(slit, 0.149), 12u);
    EXPECT_EQ(left_at(slit, 0.151), 0u);
    // From boundary to boundary no end is free, whatever the length.
    EXPECT_EQ(left_at(seam_line(0, 1), 0.39), 40u);
    // From the boundary to a free end.
    EXPECT_EQ(left_at(seam_line(0, 0.3), 0.151), 0u);
    EXPECT_EQ(left_at(seam_line(0, 0.3), 0.149), 12u);
    // A crease at the end holds it.
    EXPECT_EQ(left_at(seam_line(0, 0.3), 0.151, strip(0.3, 0.3)), 12u);
}

TEST(PruneSeams, WhatIsLeftOfAForkStays) {
    // A line across, and a spur on it.
    SeamFlags fork = seam_line(0, 1);
    const SeamFlags spur = edges_where([](const Vec3& a, const Vec3& b) {
        const auto is_on = [](const Vec3& p) {
            return std::abs(p.x() - 0.5) < 1e-9 && p.y() > 0.5 - 1e-9 && p.y() < 0.6 + 1e-9;
        };
        return is_on(a) && is_on(b);
    });
    for (std::size_t e = 0; e < fork.size(); ++e) fork[e] |= spur[e];
    ASSERT_EQ(count(fork), 44u);
    EXPECT_EQ(left_at(fork, 0.06), 40u);
    EXPECT_EQ(left_at(fork, 0.04), 44u);
}
