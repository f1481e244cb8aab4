#include "remesh/transfer/transfer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "agvd/core/error.h"
#include "agvd/core/random.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/pipeline/remesh.h"
#include "support/dirty_shapes.h"
#include "support/shapes.h"

using agvd::FaceId;
using agvd::Index;
using agvd::SurfacePoint;
using agvd::TriangleMesh;
using agvd::Vec2;
using agvd::Vec3;
using remesh::CornerCoordinates;
using remesh::find_texture_seams;
using remesh::transfer_corner_values;
using Coordinates = std::vector<CornerCoordinates>;

namespace {

// Of a corner's position in a face with a centroid.
using ValueAt = std::function<Vec2(const Vec3& corner, const Vec3& centroid)>;

Vec3 centroid(const TriangleMesh& mesh, const agvd::Triangle& t) {
    return (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3;
}

Coordinates coordinates_of(const TriangleMesh& mesh, const ValueAt& value) {
    Coordinates result;
    for (const agvd::Triangle& t : mesh.triangles) {
        const Vec3 center = centroid(mesh, t);
        const auto at = [&](Index v) { return value(mesh.positions[v], center); };
        result.push_back({at(t[0]), at(t[1]), at(t[2])});
    }
    return result;
}

struct Textured {
    remesh::RemeshResult made;
    Coordinates corners;

    [[nodiscard]] const TriangleMesh& mesh() const { return made.mesh; }
};

Textured remeshed(const TriangleMesh& mesh, const Coordinates& values,
                  remesh::RemeshOptions options, int num_threads = 0) {
    options.texture_seams = find_texture_seams(mesh.view(), values);
    Textured result{remesh::remesh(mesh.view(), options), {}};
    const auto places =
        remesh::map_to_input(mesh.view(), result.mesh().view(), result.made.sites).vertices;
    result.corners = transfer_corner_values(values, mesh.view(), result.mesh().view(), places,
                                            {.num_threads = num_threads});
    return result;
}

// The largest difference from the values that the result's corners have by formula.
double largest_error(const Textured& result, const ValueAt& value) {
    const Coordinates wanted = coordinates_of(result.mesh(), value);
    double largest = 0;
    for (std::size_t f = 0; f < wanted.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const double error = (result.corners[f][k] - wanted[f][k]).norm();
            largest = std::isnan(error) ? std::numeric_limits<double>::infinity()
                                        : std::max(largest, error);
        }
    }
    return largest;
}

double range_of_u(const CornerCoordinates& c) {
    return std::max({c[0].x(), c[1].x(), c[2].x()}) - std::min({c[0].x(), c[1].x(), c[2].x()});
}

TriangleMesh fine_cube(int levels) {
    TriangleMesh box = shapes::cube();
    for (int i = 0; i < levels; ++i) box = shapes::subdivide(box);
    return box;
}

// A chart for each side of the unit cube.
Vec2 on_side(const Vec3& p, const Vec3& center) {
    Eigen::Index axis = 0;
    const Vec3 from_middle = center - Vec3::Constant(0.5);
    from_middle.cwiseAbs().maxCoeff(&axis);
    const double side = from_middle[axis] > 0 ? 1 : 0;
    return {2 * static_cast<double>(axis) + p[(axis + 1) % 3] + 0.25 * p[(axis + 2) % 3],
            10 * side + 3 * p[(axis + 2) % 3]};
}

// Around the axis z, from 0 to 1 on each side of the half-plane y = 0, x > 0.
Vec2 unrolled(const Vec3& p, const Vec3& center) {
    const auto turn_of = [](const Vec3& q) {
        const double turn = std::atan2(q.y(), q.x()) / (2 * std::numbers::pi);
        return turn < 0 ? turn + 1 : turn;
    };
    double u = turn_of(p);
    if (u - turn_of(center) > 0.5) u -= 1;
    if (u - turn_of(center) < -0.5) u += 1;
    return {u, p.z()};
}

// Above the slit x > 1/2, y = 1/2 of the unit square, u grows twice as fast; the jump grows from 0.
Vec2 slit(const Vec3& p, const Vec3& center) {
    const bool is_above = center.y() > 0.5 && p.x() > 0.5;
    return {p.x() + (is_above ? p.x() - 0.5 : 0), p.y()};
}

}  // namespace

TEST(TransferCorners, LinearCoordinatesOnAPlaneComeBack) {
    const ValueAt linear = [](const Vec3& p, const Vec3&) {
        return Vec2(0.3 * p.x() - 0.7 * p.y() + 5, 2 * p.y());
    };
    const TriangleMesh grid = shapes::grid(24);
    const Textured result = remeshed(grid, coordinates_of(grid, linear), {.num_samples = 400});
    EXPECT_LT(largest_error(result, linear), 1e-12);
    EXPECT_EQ(result.made.features.seam_length + result.made.features.dropped_seam_length, 0);
}

TEST(TransferCorners, ABoxWithAChartForEachSideComesBack) {
    for (const bool is_welded : {true, false}) {
        const TriangleMesh box = is_welded ? fine_cube(4) : shapes::unweld(fine_cube(4));
        for (const Index n : {8U, 60U, 600U}) {
            const Textured result = remeshed(box, coordinates_of(box, on_side), {.num_samples = n});
            EXPECT_LT(largest_error(result, on_side), 1e-12) << n << ' ' << is_welded;
        }
    }
}

TEST(TransferCorners, AWrapSeamIsFollowedAndNoFaceSpansItsJump) {
    const TriangleMesh tube = shapes::tube(96, 40);
    const Coordinates values = coordinates_of(tube, unrolled);
    for (const auto& corners : values) ASSERT_LT(range_of_u(corners), 0.1);
    EXPECT_EQ(find_texture_seams(tube.view(), values).size(), 40u);
    const Textured result = remeshed(tube, values, {.num_samples = 1000});
    EXPECT_NEAR(result.made.features.seam_length, 2, 1e-9);
    EXPECT_EQ(result.made.features.dropped_seam_length, 0);
    std::vector<std::set<double>> at_vertex(result.mesh().positions.size());
    for (std::size_t f = 0; f < result.corners.size(); ++f) {
        EXPECT_LT(range_of_u(result.corners[f]), 0.2);
        for (std::size_t k = 0; k < 3; ++k) {
            at_vertex[result.mesh().triangles[f][k]].insert(result.corners[f][k].x());
        }
    }
    // On the seam each vertex has 0 on the one side, 1 on the other; elsewhere it has one value.
    Index num_on_seam = 0;
    for (Index v = 0; v < at_vertex.size(); ++v) {
        const Vec3& p = result.mesh().positions[v];
        const bool is_on_rim = p.x() > 0 && std::abs(p.y()) < 1e-9;
        num_on_seam += is_on_rim ? 1 : 0;
        ASSERT_EQ(at_vertex[v].size(), is_on_rim ? 2u : 1u) << p.transpose();
        if (!is_on_rim) continue;
        EXPECT_NEAR(*at_vertex[v].begin(), 0, 1e-9);
        EXPECT_NEAR(*at_vertex[v].rbegin(), 1, 1e-9);
    }
    EXPECT_GT(num_on_seam, 15u);
    EXPECT_LT(largest_error(result, unrolled), 2e-3);
}

TEST(TransferCorners, WithoutCurvesFacesAcrossASeamTakeOneSide) {
    const TriangleMesh tube = shapes::tube(96, 40);
    const Coordinates values = coordinates_of(tube, unrolled);
    const auto made = remesh::remesh(tube.view(), {.num_samples = 700});
    const auto places = remesh::map_to_input(tube.view(), made.mesh.view(), made.sites).vertices;
    const Coordinates corners =
        transfer_corner_values(values, tube.view(), made.mesh.view(), places);
    const double edge = made.sizing.mean_edge / (2 * std::numbers::pi);
    Index num_clipped = 0;
    for (std::size_t f = 0; f < corners.size(); ++f) {
        EXPECT_LT(range_of_u(corners[f]), 2.5 * edge);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = made.mesh.positions[made.mesh.triangles[f][k]];
            const double u = unrolled(p, p).x();
            const double off = std::abs(corners[f][k].x() - u);
            if (off < 1e-2) continue;
            // Beyond the seam: what the seam has on the face's side.
            const bool is_clipped =
                std::abs(corners[f][k].x()) < 1e-12 || std::abs(corners[f][k].x() - 1) < 1e-12;
            EXPECT_TRUE(is_clipped) << corners[f][k].x() << ' ' << u;
            ++num_clipped;
        }
    }
    EXPECT_GT(num_clipped, 20u);
}

TEST(TransferCorners, ASlitThatEndsInsideAChartIsEvaluatedOnBothSides) {
    const TriangleMesh grid = shapes::grid(24);
    const Coordinates values = coordinates_of(grid, slit);
    EXPECT_EQ(find_texture_seams(grid.view(), values).size(), 12u);
    const Textured result = remeshed(grid, values, {.num_samples = 500});
    EXPECT_NEAR(result.made.features.seam_length, 0.5, 1e-12);
    EXPECT_LT(largest_error(result, slit), 1e-9);
    Index num_above = 0;  // At the slit itself.
    for (std::size_t f = 0; f < result.corners.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = result.mesh().positions[result.mesh().triangles[f][k]];
            if (std::abs(p.y() - 0.5) > 1e-9 || p.x() < 0.6) continue;
            num_above += result.corners[f][k].x() > p.x() + 0.05 ? 1 : 0;
        }
    }
    EXPECT_GT(num_above, 5u);
}

TEST(TransferCorners, AClosedSeamPartsTheInside) {
    const TriangleMesh sphere = shapes::sphere(5);
    const ValueAt cap = [](const Vec3& p, const Vec3& center) {
        return Vec2(p.x() + (center.z() > 0.5 ? 7 : 0), p.y());
    };
    const Textured result = remeshed(sphere, coordinates_of(sphere, cap), {.num_samples = 1500});
    EXPECT_EQ(result.made.features.dropped_seam_length, 0);
    Index num_inside = 0;
    for (const CornerCoordinates& corners : result.corners) {
        EXPECT_LT(range_of_u(corners), 0.3);
        num_inside += corners[0].x() > 5 ? 1 : 0;
    }
    // A cap of a quarter of the area.
    EXPECT_NEAR(num_inside / static_cast<double>(result.corners.size()), 0.25, 0.03);
}

TEST(TransferCorners, TheFansAtThePolesOfASphereDoNotSpreadCoordinates) {
    constexpr Index around = 48, rows = 24;
    TriangleMesh sphere;
    Coordinates values;
    const auto point = [&](Index i, Index j) {
        const double a = 2 * std::numbers::pi * (i % around) / around;
        const double b = std::numbers::pi * j / rows;
        return Vec3(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), std::cos(b));
    };
    const auto vertex = [&](Index i, Index j) {
        return j == 0 ? 0 : j == rows ? 1 : 2 + (j - 1) * around + i % around;
    };
    sphere.positions = {Vec3(0, 0, 1), Vec3(0, 0, -1)};
    for (Index j = 1; j < rows; ++j) {
        for (Index i = 0; i < around; ++i) sphere.positions.push_back(point(i, j));
    }
    const auto add = [&](std::array<std::array<double, 2>, 3> corners) {
        agvd::Triangle t{};
        CornerCoordinates c;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [i, j] = corners[k];
            t[k] = vertex(static_cast<Index>(i), static_cast<Index>(j));
            c[k] = Vec2(i / around, 1 - j / rows);
        }
        sphere.triangles.push_back(t);
        values.push_back(c);
    };
    for (Index i = 0; i < around; ++i) {
        for (Index j = 0; j < rows; ++j) {
            const double a = i, b = j;
            if (j == 0)
                add({{{a + 0.5, 0}, {a, 1}, {a + 1, 1}}});
            else if (j + 1 == rows)
                add({{{a, b}, {a + 0.5, b + 1}, {a + 1, b}}});
            else {
                add({{{a, b}, {a, b + 1}, {a + 1, b + 1}}});
                add({{{a, b}, {a + 1, b + 1}, {a + 1, b}}});
            }
        }
    }
    const Textured result = remeshed(sphere, values, {.num_samples = 2000});
    // The meridian is kept, the 2 x 48 slits at the poles are shorter than two spacings.
    EXPECT_NEAR(result.made.features.seam_length, std::numbers::pi, 0.3);
    for (std::size_t f = 0; f < result.corners.size(); ++f) {
        EXPECT_LT(range_of_u(result.corners[f]), 0.5);
        const Vec3 center = centroid(result.mesh(), result.mesh().triangles[f]).normalized();
        if (std::abs(center.z()) > 0.95) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = result.mesh().positions[result.mesh().triangles[f][k]];
            const Vec2 wanted(unrolled(p, center).x(), 1 - std::acos(p.z()) / std::numbers::pi);
            EXPECT_NEAR((result.corners[f][k] - wanted).norm(), 0, 5e-3) << p.transpose();
        }
    }
}

TEST(TransferCorners, AChartForEachTriangleIsLeftToTheFaces) {
    const TriangleMesh sphere = shapes::sphere(4);
    Coordinates values;
    for (Index f = 0; f < sphere.triangles.size(); ++f) {
        values.push_back({Vec2(f, 0), Vec2(f + 0.5, 0), Vec2(f, 0.5)});
    }
    const Textured result = remeshed(sphere, values, {.num_samples = 400});
    const auto plain = remesh::remesh(sphere.view(), {.num_samples = 400});
    EXPECT_EQ(result.made.features.seam_length, 0);
    EXPECT_GT(result.made.features.dropped_seam_length, 100);
    EXPECT_EQ(result.mesh().positions, plain.mesh.positions);
    EXPECT_EQ(result.mesh().triangles, plain.mesh.triangles);
    for (const CornerCoordinates& corners : result.corners) {
        EXPECT_EQ(std::floor(corners[0].x()), std::floor(corners[1].x()));
        EXPECT_EQ(std::floor(corners[0].x()), std::floor(corners[2].x()));
    }
}

TEST(TransferCorners, WhereTheInputHasNoneTheResultHasNone) {
    const TriangleMesh grid = shapes::grid(24);
    const double none = std::numeric_limits<double>::quiet_NaN();
    const ValueAt half = [&](const Vec3& p, const Vec3& center) {
        return center.x() < 0.5 ? Vec2(none, none) : Vec2(p.x(), p.y());
    };
    const Textured result = remeshed(grid, coordinates_of(grid, half), {.num_samples = 400});
    Index num_without = 0;
    for (std::size_t f = 0; f < result.corners.size(); ++f) {
        const bool is_left = centroid(result.mesh(), result.mesh().triangles[f]).x() < 0.5;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2& value = result.corners[f][k];
            EXPECT_EQ(value.allFinite(), !is_left);
            if (is_left) continue;
            const Vec3& p = result.mesh().positions[result.mesh().triangles[f][k]];
            EXPECT_NEAR((value - p.head<2>()).norm(), 0, 1e-12);
        }
        num_without += is_left ? 1 : 0;
    }
    EXPECT_NEAR(num_without, static_cast<double>(result.corners.size()) / 2, 20);
}

TEST(TransferCorners, ACornerThatIsNearerToTheOtherSideKeepsItsOwn) {
    // Two walls that meet at 30 degrees, and a face on the first whose inner corner was moved to
    // beyond the second.
    const double angle = std::numbers::pi / 6;
    const Vec3 up(std::cos(angle), 0, std::sin(angle));
    TriangleMesh walls{
        {Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), up, up + Vec3(0, 1, 0)},
        {{0, 2, 1}, {2, 3, 1}, {0, 1, 4}, {4, 1, 5}}};
    const Coordinates values{{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)},
                             {Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)},
                             {Vec2(5, 0), Vec2(5, 1), Vec2(6, 0)},
                             {Vec2(6, 0), Vec2(5, 1), Vec2(6, 1)}};
    EXPECT_EQ(find_texture_seams(walls.view(), values).size(), 1u);
    // Its nearest point is on the second wall, but the other corners are on the first.
    const double between = 0.6 * angle;
    const Vec3 moved(0.5 * std::cos(between), 0.5, 0.5 * std::sin(between));
    const SurfacePoint on_second{FaceId(2), {0.05, 0.47, 0.48}};
    const TriangleMesh inner{{Vec3(0.3, 0.2, 0), moved, Vec3(0.3, 0.8, 0)}, {{0, 1, 2}}};
    const std::vector<SurfacePoint> inner_places{
        {FaceId(0), {0.5, 0.3, 0.2}}, on_second, {FaceId(1), {0.2, 0.1, 0.7}}};
    const Coordinates own =
        transfer_corner_values(values, walls.view(), inner.view(), inner_places);
    EXPECT_NEAR((own[0][0] - Vec2(0.3, 0.2)).norm(), 0, 1e-12);
    EXPECT_NEAR((own[0][1] - Vec2(moved.x(), 0.5)).norm(), 0, 1e-12);
    EXPECT_NEAR((own[0][2] - Vec2(0.3, 0.8)).norm(), 0, 1e-12);
    // The others lie at the seam, which belongs to both.
    const TriangleMesh outer{{Vec3(0, 0.2, 0), moved, Vec3(0, 0.8, 0)}, {{0, 1, 2}}};
    const std::vector<SurfacePoint> outer_places{
        {FaceId(0), {0.8, 0, 0.2}}, on_second, {FaceId(0), {0.2, 0, 0.8}}};
    const Coordinates other =
        transfer_corner_values(values, walls.view(), outer.view(), outer_places);
    EXPECT_NEAR((other[0][0] - Vec2(5, 0.2)).norm(), 0, 1e-12);
    EXPECT_NEAR((other[0][1] - Vec2(5.48, 0.47)).norm(), 0, 1e-12);
    EXPECT_NEAR((other[0][2] - Vec2(5, 0.8)).norm(), 0, 1e-12);
}

TEST(TransferCorners, AVertexBetweenTwoSlopesHasOneValue) {
    // A tent, and two triangles with a seam elsewhere. The vertex is as near to both slopes.
    const TriangleMesh input{
        {Vec3(-1, 0, 0), Vec3(-1, 1, 0), Vec3(0, 0, 1), Vec3(0, 1, 1), Vec3(1, 0, 0), Vec3(1, 1, 0),
         Vec3(9, 0, 0), Vec3(8, 0, 0), Vec3(8, 1, 0), Vec3(9, 1, 0)},
        {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}, {6, 7, 8}, {6, 8, 9}}};
    const Coordinates values = coordinates_of(input, [](const Vec3& p, const Vec3& center) {
        return Vec2(p.x() + (center.x() > 8.5 ? 1 : 0), p.y());
    });
    ASSERT_EQ(find_texture_seams(input.view(), values).size(), 1u);
    const TriangleMesh result{{Vec3(0, 0.5, 0.8), Vec3(-0.5, 0.2, 0.5), Vec3(0.5, 0.2, 0.5),
                               Vec3(0.5, 0.8, 0.5), Vec3(-0.5, 0.8, 0.5)},
                              {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
    const std::vector<SurfacePoint> places{{FaceId(0), {0.1, 0.4, 0.5}},
                                           {FaceId(0), {0.5, 0.3, 0.2}},
                                           {FaceId(2), {0.5, 0.3, 0.2}},
                                           {FaceId(3), {0.2, 0.5, 0.3}},
                                           {FaceId(1), {0.2, 0.5, 0.3}}};
    const Coordinates corners = transfer_corner_values(values, input.view(), result.view(), places);
    for (const CornerCoordinates& of_face : corners) {
        EXPECT_EQ(of_face[0], corners[0][0]);
        EXPECT_NEAR((of_face[0] - Vec2(-0.1, 0.5)).norm(), 0, 1e-12);
    }
}

TEST(TransferCorners, TheRingOfDataComesBack) {
    const remesh::MeshFile ring =
        remesh::read_mesh(AGVD_DATA_DIR "/ring.obj", remesh::ReadOptions{.with_attributes = true});
    const remesh::TextureCoordinates& texture = ring.attributes.texture;
    ASSERT_EQ(texture.seams.size(), 96u);
    const Textured result = remeshed(ring.mesh, texture.corners, {.num_samples = 2000});
    EXPECT_EQ(result.made.features.dropped_seam_length, 0);
    // Turns, on the side of the face's centroid.
    const auto turns = [](double y, double x, double of_centroid) {
        const double turn = std::atan2(y, x) / (2 * std::numbers::pi);
        return turn + std::round(of_centroid - turn);
    };
    const auto turn_of = [](const Vec3& p) {
        const double ring_turn = std::atan2(p.z(), p.x()) / (2 * std::numbers::pi);
        const double tube_turn =
            std::atan2(p.y(), std::hypot(p.x(), p.z()) - 1) / (2 * std::numbers::pi);
        return Vec2(ring_turn < 0 ? ring_turn + 1 : ring_turn,
                    tube_turn < 0 ? tube_turn + 1 : tube_turn);
    };
    double sum_sq = 0, largest = 0;
    std::map<std::pair<Index, Index>, std::vector<std::pair<Vec2, Vec2>>> sides;  // Of edges.
    for (std::size_t f = 0; f < result.corners.size(); ++f) {
        const agvd::Triangle& t = result.mesh().triangles[f];
        const Vec2 center = turn_of(centroid(result.mesh(), t));
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = result.mesh().positions[t[k]];
            const Vec2 wanted(turns(p.z(), p.x(), center.x()),
                              turns(p.y(), std::hypot(p.x(), p.z()) - 1, center.y()));
            const double error = (result.corners[f][k] - wanted).norm();
            sum_sq += error * error;
            largest = std::max(largest, error);
            const std::size_t next = (k + 1) % 3;
            auto ends = std::pair(result.corners[f][k], result.corners[f][next]);
            if (t[k] > t[next]) std::swap(ends.first, ends.second);
            sides[std::minmax(t[k], t[next])].push_back(ends);
        }
    }
    const double rms = std::sqrt(sum_sq / (3.0 * static_cast<double>(result.corners.size())));
    std::size_t num_on_seams = 0;
    for (const auto& [edge, found] : sides) {
        ASSERT_EQ(found.size(), 2u);
        num_on_seams += found[0] != found[1] ? 1 : 0;
    }
    const double share = static_cast<double>(num_on_seams) / static_cast<double>(sides.size());
    std::printf("ring: RMS error %.2g, largest %.2g, %zu of %zu edges on seams (%.2f %%)\n", rms,
                largest, num_on_seams, sides.size(), 100 * share);
    EXPECT_LT(rms, 1e-3);
    EXPECT_LT(largest, 1e-2);
    // Seams of lengths 2 pi 1.4 and 2 pi .4, with edges of the mean length.
    const double wanted = 2 * std::numbers::pi * 1.8 / result.made.sizing.mean_edge;
    EXPECT_NEAR(static_cast<double>(num_on_seams) / wanted, 1, 0.15);
}

TEST(TransferCorners, ThreadsDoNotChangeBits) {
    const TriangleMesh tube = shapes::jitter(shapes::tube(60, 30), 0.01, 3);
    const Coordinates values = coordinates_of(tube, unrolled);
    const Textured one = remeshed(tube, values, {.num_samples = 500}, 1);
    const Textured many = remeshed(tube, values, {.num_samples = 500}, 8);
    EXPECT_EQ(one.corners, many.corners);
}

TEST(TransferCorners, WrongSizesAreNamed) {
    const TriangleMesh grid = shapes::grid(2);
    const Coordinates few(3, remesh::no_coordinates());
    EXPECT_THROW(static_cast<void>(find_texture_seams(grid.view(), few)), agvd::InvalidOption);
    EXPECT_THROW(static_cast<void>(transfer_corner_values(few, grid.view(), grid.view(), {})),
                 agvd::InvalidOption);
}

TEST(TextureSeams, AreEdgesWhereCoordinatesDisagree) {
    const TriangleMesh grid = shapes::grid(4);
    const auto seams_of = [&](const ValueAt& value) {
        return find_texture_seams(grid.view(), coordinates_of(grid, value));
    };
    const auto shifted = [&](double by) {
        return seams_of([by](const Vec3& p, const Vec3& center) {
            return Vec2(p.x() + (center.x() > 0.5 ? by : 0), p.y());
        });
    };
    EXPECT_TRUE(shifted(0).empty());
    EXPECT_TRUE(shifted(1e-7).empty());  // Rounding of the file.
    const auto seams = shifted(1e-3);
    ASSERT_EQ(seams.size(), 4u);
    for (const auto& [a, b] : seams) {
        EXPECT_EQ(grid.positions[a].x(), 0.5);
        EXPECT_EQ(grid.positions[b].x(), 0.5);
    }
    const TriangleMesh soup = shapes::unweld(grid);
    const Coordinates values = coordinates_of(soup, [](const Vec3& p, const Vec3& center) {
        return Vec2(p.x() + (center.x() > 0.5 ? 1 : 0), p.y());
    });
    EXPECT_EQ(find_texture_seams(soup.view(), values).size(), 4u);
}
