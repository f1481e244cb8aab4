#include "agvd/intrinsic/intrinsic_triangulation.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "agvd/mesh/surface.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// A slab, a bumpy sphere and an egg: flips there cross creases.
std::vector<TriangleMesh> bent_shapes() {
    TriangleMesh slab = shapes::cube();
    for (Vec3& p : slab.positions) p.z() *= 0.2;
    TriangleMesh egg = shapes::sphere(2);
    for (Vec3& p : egg.positions) p.z() *= 2;
    return {slab, shapes::jitter(shapes::sphere(3), 0.08, 7), egg};
}

Vec3 area_vector(const TriangleMesh& mesh, Index face) {
    const auto& [a, b, c] = mesh.triangles[face];
    const auto& p = mesh.positions;
    return (p[b] - p[a]).cross(p[c] - p[a]) / 2;
}

// The integral of n n^T over the surface, and of the position.
struct Sums {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    Vec3 first = Vec3::Zero();

    void add(const Vec3& vector, const Vec3& centroid) {
        spread += vector * vector.transpose() / vector.norm();
        first += vector.norm() * centroid;
    }
};

}  // namespace

TEST(FacePieces, OfAllFacesTheyAreTheSurface) {
    for (const TriangleMesh& mesh : bent_shapes()) {
        const Surface surface = build_surface(mesh.view());
        Sums expected;
        double area = 0;
        for (Index f = 0; f < surface.num_faces(); ++f) {
            const auto& [a, b, c] = mesh.triangles[f];
            const auto& p = mesh.positions;
            expected.add(area_vector(mesh, f), (p[a] + p[b] + p[c]) / 3);
            area += face_area(surface, f);
        }
        for (const double max_length : {1e9, 0.3}) {
            const IntrinsicTriangulation base(surface, {.max_length = max_length});
            const FacePieces pieces(base, 1e9);
            Sums found;
            std::size_t num_bent = 0;
            for (Index f = 0; f < base.surface().num_faces(); ++f) {
                double sum = 0;
                Index count = 0;
                pieces.for_each(f, [&](const SurfacePiece& piece) {
                    found.add(piece.vector, piece.position);
                    sum += piece.vector.norm();
                    ++count;
                });
                EXPECT_NEAR(sum, face_area(base.surface(), f), 1e-9 * area) << f;
                num_bent += count > 1 ? 1 : 0;
                if (!base.is_changed(f)) {
                    EXPECT_EQ(count, 1u);
                }
            }
            if (max_length < 1) {
                EXPECT_GT(num_bent, 10u);
            }
            EXPECT_LT((found.spread - expected.spread).norm(), 1e-9 * area);
            EXPECT_LT((found.first - expected.first).norm(), 1e-9 * area);
        }
    }
}

TEST(FacePieces, BentFacesHaveAPieceForEachFaceOfTheInputInThem) {
    // Two triangles at a right angle whose common edge is flipped.
    const TriangleMesh bent{{{0, 0, 0}, {4, 0, 0}, {2, 1, 0}, {2, 0, 1}}, {{0, 1, 2}, {1, 0, 3}}};
    const Surface surface = build_surface(bent.view());
    const IntrinsicTriangulation base(surface);
    ASSERT_TRUE(base.is_changed(0) && base.is_changed(1));
    const FacePieces pieces(base, 1e9);
    for (Index f = 0; f < 2; ++f) {
        std::vector<Vec3> normals;
        pieces.for_each(f, [&](const SurfacePiece& piece) {
            EXPECT_NEAR(piece.vector.norm(), 1, 1e-12);
            normals.push_back(piece.vector.normalized());
        });
        ASSERT_EQ(normals.size(), 2u);
        EXPECT_NEAR(std::abs(normals[0].dot(normals[1])), 0, 1e-12);
    }
}

TEST(FacePieces, FacesThatAreFlatInSpaceAreOnePiece) {
    TriangleMesh strip;  // A square in needles: all flips are within its plane.
    for (Index i = 0; i <= 20; ++i) {
        strip.positions.emplace_back(i / 20.0, 0, 0);
        strip.positions.emplace_back(i / 20.0, 1, 0);
        if (i == 0) continue;
        const Index a = 2 * i - 2;
        strip.triangles.insert(strip.triangles.end(), {{a, a + 2, a + 3}, {a, a + 3, a + 1}});
    }
    const Surface surface = build_surface(strip.view());
    const IntrinsicTriangulation base(surface, {.max_length = 0.2});
    const FacePieces pieces(base, 1e-6);
    for (Index f = 0; f < base.surface().num_faces(); ++f) {
        Index count = 0;
        pieces.for_each(f, [&](const SurfacePiece& piece) {
            ++count;
            EXPECT_NEAR(piece.position.z(), 0, 1e-15);
            EXPECT_NEAR(piece.vector.z(), face_area(base.surface(), f), 1e-12);
        });
        EXPECT_EQ(count, 1u);
    }
}

// Faces of a rolled sheet of needles have too many parts: they get points inside them, evenly
// spread.
TEST(FacePieces, FacesOfManyNeedlesHavePointsInside) {
    constexpr Index columns = 400, rows = 4;
    TriangleMesh sheet;
    for (Index i = 0; i <= columns; ++i) {
        const double angle = static_cast<double>(i) / columns;
        for (Index j = 0; j <= rows; ++j) {
            sheet.positions.emplace_back(std::cos(angle), std::sin(angle), 0.25 * j);
            if (i == 0 || j == 0) continue;
            const Index d = i * (rows + 1) + j, c = d - 1, b = d - (rows + 1), a = b - 1;
            sheet.triangles.insert(sheet.triangles.end(), {{a, c, d}, {a, d, b}});
        }
    }
    const Surface surface = build_surface(sheet.view());
    const IntrinsicTriangulation base(surface, {.min_length = 0.3});
    const FacePieces pieces(base, 1e-3);
    const auto unrolled = [](const Vec3& p) { return Vec2(std::atan2(p.y(), p.x()), p.z()); };
    const auto area = [](const Vec2& a, const Vec2& b, const Vec2& c) {
        return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
    };
    Index num_spread = 0;
    for (Index f = 0; f < base.surface().num_faces(); ++f) {
        std::array<Vec2, 3> corner;
        for (std::size_t k = 0; k < 3; ++k) {
            corner[k] = unrolled(sheet.positions[base.surface().mesh.triangles[f][k]]);
        }
        const double whole = area(corner[0], corner[1], corner[2]);
        if (whole < 0.1) continue;  // Fewer parts.
        Index count = 0;
        pieces.for_each(f, [&](const SurfacePiece& piece) {
            ++count;
            const Vec2 p = unrolled(piece.position);
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_GT(area(p, corner[(k + 1) % 3], corner[(k + 2) % 3]), 0.005 * whole);
            }
        });
        EXPECT_EQ(count, 16u);
        ++num_spread;
    }
    EXPECT_EQ(num_spread, 2u);
}

TEST(FacePieces, AreTheSameForAnyNumberOfThreads) {
    // So many faces that they are several chunks.
    const Surface surface = build_surface(shapes::jitter(shapes::torus(160, 80), 0.004, 5).view());
    const IntrinsicTriangulation base(surface);
    const auto list = [&](int num_threads) {
        const FacePieces pieces(base, 1e-4, num_threads);
        std::vector<Vec3> found;
        for (Index f = 0; f < base.surface().num_faces(); ++f) {
            pieces.for_each(f, [&](const SurfacePiece& piece) {
                found.push_back(piece.position);
                found.push_back(piece.vector);
            });
        }
        return found;
    };
    const std::vector<Vec3> one = list(1);
    ASSERT_GT(one.size(), 2 * base.surface().num_faces() + 100u);
    for (const int threads : {2, 8}) EXPECT_EQ(one, list(threads));
}
