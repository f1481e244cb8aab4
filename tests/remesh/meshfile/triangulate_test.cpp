#include "remesh/meshfile/mesh_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "support/dice.h"

using agvd::Index;
using agvd::Triangle;
using agvd::Vec3;

namespace {

std::vector<Triangle> cut(const std::vector<Vec3>& positions) {
    std::vector<Index> polygon(positions.size());
    std::iota(polygon.begin(), polygon.end(), Index{0});
    std::vector<Triangle> triangles;
    agvd::Ticker ticker;
    remesh::append_triangles(polygon, positions, ticker, triangles);
    return triangles;
}

// Cut right: as many triangles as there should be, none flipped, and areas that sum to `area`.
void expect_partition(const std::vector<Vec3>& positions, const Vec3& normal, double area) {
    const auto triangles = cut(positions);
    ASSERT_EQ(triangles.size(), positions.size() - 2);
    double sum = 0;
    for (const auto& [a, b, c] : triangles) {
        const double twice =
            normal.dot((positions[b] - positions[a]).cross(positions[c] - positions[a]));
        EXPECT_GE(twice, 0);
        sum += twice / 2;
    }
    EXPECT_NEAR(sum, area, 1e-12 * area);
}

}  // namespace

TEST(Triangulate, QuadsAreCutAlongTheShorterDiagonal) {
    EXPECT_EQ(cut({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 1, 0}}),
              (std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}}));
    EXPECT_EQ(cut({{1, 0, 0}, {3, 0, 0}, {2, 1, 0}, {0, 1, 0}}),
              (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Triangulate, ConcaveQuadsAreCutInside) {
    // Both darts have their reflex corner on the longer diagonal.
    const std::vector<Vec3> dart = {{0, 0, 0}, {4, -1, 0}, {1, 0, 0}, {4, 1, 0}};
    EXPECT_EQ(cut(dart), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(cut({dart[3], dart[0], dart[1], dart[2]}),
              (std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}}));
    const std::vector<Vec3> long_dart = {{-9, 0, 0}, {1, -1, 0}, {0, 0, 0}, {1, 1, 0}};
    EXPECT_EQ(cut(long_dart), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Triangulate, ConcavePolygonsAreCutInside) {
    // A star, in four orientations of its plane.
    for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 2, -3), Vec3(-5, 1, 0)}) {
        const Vec3 n = normal.normalized();
        const Vec3 u = n.unitOrthogonal(), v = n.cross(u);
        std::vector<Vec3> star;
        const int points = 7;
        for (int i = 0; i < 2 * points; ++i) {
            const double r = i % 2 == 0 ? 3 : 0.5, angle = std::numbers::pi * i / points;
            star.push_back(r * std::cos(angle) * u + r * std::sin(angle) * v);
        }
        expect_partition(star, n, points * 3 * 0.5 * std::sin(std::numbers::pi / points));
    }
}

TEST(Triangulate, AHoleOnABridgeStaysOpen) {
    // A square of side 4 with a hole of side 2, joined by the bridge between (0, 0) and (1, 1).
    expect_partition({{0, 0, 0},
                      {4, 0, 0},
                      {4, 4, 0},
                      {0, 4, 0},
                      {0, 0, 0},
                      {1, 1, 0},
                      {1, 3, 0},
                      {3, 3, 0},
                      {3, 1, 0},
                      {1, 1, 0}},
                     Vec3::UnitZ(), 12);
}

TEST(Triangulate, CombsAndStaircasesAreCutInside) {
    std::vector<Vec3> comb = {{0, 0, 0}};
    for (int i = 0; i < 20; ++i) {
        comb.emplace_back(2 * i, -5, 0);
        comb.emplace_back(2 * i + 1, 0, 0);
    }
    comb.emplace_back(39, 1, 0);
    comb.emplace_back(0, 1, 0);
    comb.erase(comb.begin());
    double area = 0;
    for (std::size_t i = 0; i < comb.size(); ++i) {
        const Vec3 &a = comb[i], &b = comb[(i + 1) % comb.size()];
        area += (a.x() * b.y() - a.y() * b.x()) / 2;
    }
    expect_partition(comb, Vec3::UnitZ(), area);
}

TEST(Triangulate, RoundPolygonsGetNoSliversAroundOneCorner) {
    std::vector<Vec3> disc;
    const int n = 64;
    for (int i = 0; i < n; ++i) {
        disc.emplace_back(std::cos(2 * std::numbers::pi * i / n),
                          std::sin(2 * std::numbers::pi * i / n), 0);
    }
    expect_partition(disc, Vec3::UnitZ(), n / 2.0 * std::sin(2 * std::numbers::pi / n));
    std::vector<int> valence(n, 0);
    for (const auto& triangle : cut(disc)) {
        for (const Index v : triangle) ++valence[v];
    }
    EXPECT_LE(*std::max_element(valence.begin(), valence.end()), 2 * std::log2(n));
}

// Every corner was looked at for every ear: 20 000 took a minute.
TEST(Triangulate, RoughPolygonsOfManyCornersAreCutInside) {
    Dice dice(7);
    std::vector<Vec3> star;
    constexpr int count = 20000;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count, radius = dice.number(1, 1.5);
        star.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
    double area = 0;
    for (std::size_t i = 0; i < star.size(); ++i) {
        area += star[i].cross(star[(i + 1) % star.size()]).z() / 2;
    }
    expect_partition(star, {0, 0, 1}, area);
}

TEST(Triangulate, PolygonsWithoutAnAnswerStillEnd) {
    EXPECT_EQ(cut(std::vector<Vec3>(9, Vec3(1, 2, 3))).size(), 7u);
    EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}).size(), 3u);
    EXPECT_EQ(cut({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 2u);
    EXPECT_EQ(cut({{0, 0, 0}, {2, 2, 0}, {0, 2, 0}, {2, 0, 0}, {1, 3, 0}}).size(), 3u);
    EXPECT_EQ(cut({{1e300, 0, 0}, {0, 1e300, 0}, {-1e300, 0, 0}, {0, -1e300, 0}, {1, 1, 0}}).size(),
              3u);
}
