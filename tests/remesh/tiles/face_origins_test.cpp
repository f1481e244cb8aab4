#include "remesh/tiles/face_origins.h"

#include <gtest/gtest.h>

using agvd::FaceId;
using agvd::Index;
using agvd::Triangle;
using agvd::Vec3;
using remesh::between;
using remesh::PartPoint;
using remesh::Weights;
using remesh::whole_face;

namespace {

const std::array<Vec3, 3> corners{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 1, 0)};

Vec3 at(const Weights& w) { return w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2]; }

double area_of(const std::vector<PartPoint>& polygon, const Triangle& t) {
    const Vec3 a = at(polygon[t[0]].weights), b = at(polygon[t[1]].weights),
               c = at(polygon[t[2]].weights);
    return (b - a).cross(c - a).z() / 2;
}

TEST(FaceOrigins, TakesPointsToTheWhole) {
    remesh::FaceOrigins parts;
    parts.add_whole(7);
    parts.add(9, {Weights{1, 0, 0}, between(whole_face[0], whole_face[1], 0.5), Weights{0, 0, 1}});
    ASSERT_EQ(parts.num_faces(), 2u);
    EXPECT_EQ(parts.to_whole({FaceId(0), {0.2, 0.3, 0.5}}),
              (agvd::SurfacePoint{FaceId(7), {0.2, 0.3, 0.5}}));
    EXPECT_EQ(parts.to_whole({FaceId(1), {0, 1, 0}}),
              (agvd::SurfacePoint{FaceId(9), {0.5, 0.5, 0}}));
    EXPECT_EQ(parts.to_whole({FaceId(1), {0.5, 0.5, 0}}),
              (agvd::SurfacePoint{FaceId(9), {0.75, 0.25, 0}}));
    EXPECT_EQ(parts.half_edge_of_whole(3 * 0 + 2), 3 * 7 + 2u);
    EXPECT_EQ(parts.half_edge_of_whole(3 * 1 + 0), 3 * 9 + 0u);
    EXPECT_EQ(parts.half_edge_of_whole(3 * 1 + 1), agvd::no_index) << "inside the face";
    EXPECT_EQ(parts.half_edge_of_whole(3 * 1 + 2), 3 * 9 + 2u);
    remesh::FaceOrigins copies;
    copies.add(parts, 1);
    copies.add(parts, 0);
    EXPECT_EQ(copies.face(0), 9u);
    EXPECT_EQ(copies.corners(0), parts.corners(1));
    EXPECT_EQ(copies.face(1), 7u);
}

TEST(TriangulatePart, PointsOnSidesLeaveNoFlatTriangle) {
    int count = 0;
    for (const int on_first : {0, 1, 2, 5}) {
        for (const int on_second : {0, 1, 4}) {
            for (const int on_third : {0, 3}) {
                std::vector<PartPoint> polygon;
                const std::array<int, 3> added{on_first, on_second, on_third};
                for (Index k = 0; k < 3; ++k) {
                    for (int i = 0; i <= added[k]; ++i) {
                        const auto number = static_cast<Index>(polygon.size());
                        polygon.push_back({number, between(whole_face[k], whole_face[(k + 1) % 3],
                                                           i / (1.0 + added[k]))});
                    }
                }
                const std::vector<Triangle> triangles = remesh::triangulate_part(corners, polygon);
                EXPECT_EQ(triangles.size(), polygon.size() - 2);
                double sum = 0;
                for (const Triangle& t : triangles) {
                    EXPECT_GT(area_of(polygon, t), 1e-3);
                    sum += area_of(polygon, t);
                }
                EXPECT_NEAR(sum, 1, 1e-14);
                ++count;
            }
        }
    }
    EXPECT_EQ(count, 24);
}

}  // namespace
