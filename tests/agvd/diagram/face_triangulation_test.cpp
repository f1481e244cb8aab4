// Triangles of points inside a face.
#include "agvd/diagram/face_triangulation.h"

#include <gtest/gtest.h>

#include "agvd/diagram/face_relays.h"
#include "support/dice.h"

using namespace agvd;

namespace {

const std::array<Vec2, 3> corners{Vec2(0, 0), Vec2(1, 0), Vec2(0.3, 0.7)};

double doubled_area(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

// Of triangles that fill the face and know their neighbours.
void expect_fills_face(const std::vector<Vec2>& points, const FaceTriangulation& triangulation) {
    const auto& pieces = triangulation.pieces();
    EXPECT_EQ(pieces.size(), 2 * (points.size() - 3) + 1);
    double sum = 0;
    for (Index i = 0; i < pieces.size(); ++i) {
        const auto& [a, b, c] = pieces[i].points;
        const double area = doubled_area(points[a], points[b], points[c]);
        EXPECT_GE(area, -1e-15);
        sum += area;
        for (std::size_t k = 0; k < 3; ++k) {
            const Index from = pieces[i].points[k];
            const Index to = pieces[i].points[(k + 1) % 3];
            const Index neighbour = pieces[i].neighbours[k];
            if (neighbour == no_index) {
                EXPECT_EQ(to, (from + 1) % 3);
                continue;
            }
            std::size_t j = 0;
            while (j < 3 && pieces[neighbour].points[j] != to) ++j;
            ASSERT_LT(j, 3u);
            EXPECT_EQ(pieces[neighbour].points[(j + 1) % 3], from);
            EXPECT_EQ(pieces[neighbour].neighbours[j], i);
        }
    }
    EXPECT_NEAR(sum, doubled_area(corners[0], corners[1], corners[2]), 1e-12);
}

Vec2 in_face(double u, double v) {
    return corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
}

}  // namespace

TEST(FaceTriangulation, OfRandomPointsIsDelaunay) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Dice dice(seed);
        std::vector<Vec2> points(corners.begin(), corners.end());
        FaceTriangulation triangulation;
        triangulation.reset(corners);
        for (int i = 0; i < 100; ++i) {
            const double u = dice.number(0, 1);
            points.push_back(in_face(u, dice.number(0, 1 - u)));
            triangulation.add(points.back());
        }
        expect_fills_face(points, triangulation);
        for (const auto& piece : triangulation.pieces()) {
            const Vec2& a = points[piece.points[0]];
            const Vec2 b = points[piece.points[1]] - a;
            const Vec2 c = points[piece.points[2]] - a;
            const Vec2 centre = Vec2(c.y() * b.squaredNorm() - b.y() * c.squaredNorm(),
                                     b.x() * c.squaredNorm() - c.x() * b.squaredNorm()) /
                                (2 * cross(b, c));
            for (const Vec2& p : points) {
                EXPECT_GE((p - a - centre).norm(), centre.norm() * (1 - 1e-6));
            }
        }
    }
}

TEST(FaceTriangulation, PointsOnALineOnACircleOrInOnePlaceFillTheFace) {
    std::vector<Vec2> points(corners.begin(), corners.end());
    FaceTriangulation triangulation;
    triangulation.reset(corners);
    const auto add = [&](const Vec2& p) {
        points.push_back(p);
        triangulation.add(p);
    };
    for (int i = 1; i < 10; ++i) {
        for (int j = 1; i + j < 10; ++j) add(in_face(i / 10.0, j / 10.0));
    }
    add(in_face(0.1, 0.1));
    add(in_face(0.25, 0.5));
    add(in_face(1e-17, 0.5));
    expect_fills_face(points, triangulation);
}
