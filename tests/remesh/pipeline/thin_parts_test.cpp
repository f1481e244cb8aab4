// Rods thinner than the spacing get edges that are short enough to go around them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "remesh/meshfile/mesh_file.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"
#include "remesh/sites/narrow_lengths.h"
#include "support/files.h"
#include "support/parts.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::RemeshResult;

namespace {

// A unit ball with a rod of length 2 on top.
TriangleMesh ball_with_rod(double radius) {
    constexpr Index sides = 24, rings_of_ball = 60, rings_of_rod = 120;
    std::vector<std::pair<double, double>> profile;  // Distance from the axis, height.
    const double end = std::numbers::pi - std::asin(radius);
    for (Index i = 1; i <= rings_of_ball; ++i) {
        const double angle = end * i / rings_of_ball;
        profile.emplace_back(std::sin(angle), -std::cos(angle));
    }
    for (Index i = 1; i <= rings_of_rod; ++i) {
        profile.emplace_back(radius, -std::cos(end) + 2.0 * i / rings_of_rod);
    }
    TriangleMesh mesh;
    mesh.positions.emplace_back(0, 0, -1);
    for (const auto& [r, z] : profile) {
        for (Index k = 0; k < sides; ++k) {
            const double angle = 2 * std::numbers::pi * k / sides;
            mesh.positions.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
        }
    }
    const auto top = static_cast<Index>(mesh.positions.size());
    mesh.positions.emplace_back(0, 0, profile.back().second + radius);
    for (Index k = 0; k < sides; ++k) {
        const Index next = (k + 1) % sides, last = top - sides;
        mesh.triangles.push_back({0, 1 + next, 1 + k});
        mesh.triangles.push_back({last + k, last + next, top});
        for (Index ring = 1; ring < last; ring += sides) {
            const Index above = ring + sides;
            mesh.triangles.push_back({ring + k, ring + next, above + next});
            mesh.triangles.push_back({ring + k, above + next, above + k});
        }
    }
    return mesh;
}

// Of the sites in the mean, and of their edges.
constexpr double spacing = 0.8;
const double even_edge = std::sqrt(2 / std::numbers::sqrt3) * spacing;

// As long as ten spacings.
TriangleMesh pipe(double radius) {
    TriangleMesh mesh = shapes::tube(60, 300);
    double low = std::numeric_limits<double>::infinity(), high = -low, around = 0;
    for (const Vec3& p : mesh.positions) {
        low = std::min(low, p.z());
        high = std::max(high, p.z());
        around = std::max(around, std::hypot(p.x(), p.y()));
    }
    for (Vec3& p : mesh.positions) {
        p = {p.x() * radius / around, p.y() * radius / around,
             (p.z() - low) / (high - low) * 10 * spacing};
    }
    return mesh;
}

// Most sites lie on the plate.
TriangleMesh pipe_and_plate(double radius) {
    TriangleMesh plate = shapes::grid(1);
    for (Vec3& p : plate.positions) p = 17 * p + Vec3(5, 0, 1);
    return shapes::join(pipe(radius), plate);
}

// Where a cell wraps around the lower end of a pipe.
// \param edge  of all edges.
std::vector<double> lengths_at_end(const agvd::IntrinsicTriangulation& base, double num_sites,
                                   double edge = even_edge) {
    const TriangleMesh& mesh = base.input().mesh;
    Index lowest = 0;
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        if (mesh.positions[mesh.triangles[f][0]].z() <
            mesh.positions[mesh.triangles[lowest][0]].z()) {
            lowest = f;
        }
    }
    const agvd::SurfacePoint place{agvd::FaceId(lowest), {1, 0, 0}};
    agvd::Ticker ticker;
    const std::vector<double> even(base.surface().num_vertices(), edge);
    return remesh::detail::narrow_lengths(base, {&place, 1}, {}, even, num_sites,
                                          std::log(remesh::Sizing{}.gradation), ticker);
}

double distance_in_diagonals(const RemeshResult& result) {
    return result.verdict.largest_distance / result.verdict.diagonal;
}

}  // namespace

TEST(ThinParts, ARodKeepsItsLength) {
    for (const auto& [radius, is_adaptive] : {std::pair(0.03, false), {0.015, true}}) {
        remesh::Sizing sizing;
        if (is_adaptive) sizing.edges = remesh::AdaptiveEdges{};
        const RemeshResult result =
            remesh::remesh(ball_with_rod(radius).view(), {.num_samples = 1000, .sizing = sizing});
        EXPECT_EQ(result.mesh.positions.size(), 1000u);
        // With equal edges: 8 to 12 %.
        EXPECT_LT(distance_in_diagonals(result), 0.02) << radius << ' ' << is_adaptive;
        EXPECT_GT(result.verdict.min_angle, 15 * std::numbers::pi / 180);
    }
}

TEST(ThinParts, ArmsGetTheirShareOfTheVertices) {
    const TriangleMesh mesh = remesh::read_mesh(files::find_mesh("data/organic.ply")).mesh;
    for (const std::uint64_t seed : {0u, 1u, 2u, 3u}) {
        const RemeshResult result = remesh::remesh(mesh.view(), {.num_samples = 500, .seed = seed});
        const auto apart =
            remesh::surface_distance(mesh.view(), result.mesh.view(), {.samples = 20'000});
        if (!apart) GTEST_SKIP() << "distances need CGAL";
        // Where sites on arms do not move: .0025 to .0044. With seed 2 faces are parted: .0031.
        EXPECT_LT(apart->two_sided().rms, 0.0032 * result.verdict.diagonal) << seed;
    }
}

TEST(ThinParts, OthersHaveEqualEdges) {
    const RemeshResult result = remesh::remesh(ball_with_rod(0.2).view(), {.num_samples = 1000});
    EXPECT_EQ(result.sizing.least_target, 0);
}

// Where sites on the rod do not move 1.1 of 2 are lost.
TEST(ThinParts, FewVerticesSufficeForARod) {
    const RemeshResult result = remesh::remesh(ball_with_rod(0.03).view(), {.num_samples = 80});
    EXPECT_LT(result.verdict.largest_distance, 0.4);
    EXPECT_EQ(result.sizing.least_target, 0);
}

// Cells wrap around the rod: without its sites 2 of it are lost.
TEST(ThinParts, AThinnerRodKeepsItsSites) {
    const RemeshResult result = remesh::remesh(ball_with_rod(0.015).view(), {.num_samples = 600});
    EXPECT_LT(result.verdict.largest_distance, 0.2);
    EXPECT_GE(result.dual.narrow_sites, 10u);
    EXPECT_GE(result.dual.simplified_parts, 1u);
    EXPECT_GT(result.dual.sites_of_cells, 480u);
}

TEST(ThinParts, LengthsThatTheCallerGivesStay) {
    const TriangleMesh mesh = ball_with_rod(0.03);
    const RemeshResult result = remesh::remesh(
        mesh.view(),
        {.num_samples = 1000,
         .sizing = {.edges = remesh::VertexLengths{std::vector(mesh.positions.size(), 1.0)}}});
    EXPECT_NEAR(result.sizing.least_target, result.sizing.largest_target,
                1e-9 * result.sizing.largest_target);
}

TEST(ThinParts, FiveVerticesLieAroundACylinder) {
    for (const double radius : {0.15, 0.04}) {
        const TriangleMesh mesh = pipe_and_plate(radius);
        const agvd::Surface surface = agvd::build_surface(mesh.view());
        const agvd::IntrinsicTriangulation base(surface, {.max_length = 0.05});
        const std::vector<double> length = lengths_at_end(base, 4000);
        Index near = 0, far = 0;
        for (Index v = 0; v < length.size(); ++v) {
            const Vec3& p = base.surface().mesh.positions[v];
            // Not at the end, where patches are cut off.
            if (p.x() < 1 && p.z() > 0.5 * spacing && p.z() < 2 * spacing) {
                ++near;
                const double wanted = std::max(2 * std::numbers::pi / 5 * radius, spacing / 8);
                EXPECT_GE(length[v], 0.75 * wanted);
                EXPECT_LE(length[v], 1.8 * wanted);
            } else if (p.x() > 1 || p.z() > 4 * spacing) {
                ++far;
                EXPECT_EQ(length[v], std::numeric_limits<double>::infinity());
            }
        }
        EXPECT_GT(near, 50u);
        EXPECT_GT(far, 50u);
    }
}

// Where edges are short by themselves a part is not narrow.
TEST(ThinParts, EdgesThatAreShortAnywayStay) {
    const TriangleMesh mesh = pipe_and_plate(0.15);  // Five edges around are .188 long.
    const agvd::Surface surface = agvd::build_surface(mesh.view());
    const agvd::IntrinsicTriangulation base(surface, {.max_length = 0.05});
    EXPECT_EQ(std::ranges::min(lengths_at_end(base, 4000, 0.12)),
              std::numeric_limits<double>::infinity());
    const double least = std::ranges::min(lengths_at_end(base, 4000, 0.3));
    EXPECT_GT(least, 0.12);
    EXPECT_LT(least, 0.25);
}

TEST(ThinParts, TakeAQuarterOfTheOtherSitesAtMost) {
    for (const double radius : {0.15, 0.04}) {
        const TriangleMesh mesh = pipe(radius);
        const agvd::Surface surface = agvd::build_surface(mesh.view());
        const agvd::IntrinsicTriangulation base(surface, {.max_length = 0.05});
        const std::vector<double> length = lengths_at_end(base, 40);
        double more = 0, others = 0;
        for (Index f = 0; f < base.surface().num_faces(); ++f) {
            const Index h = 3 * f;
            const double area = base.surface().length_of(h) * base.surface().apex[h].y() / 2;
            for (const Index v : base.surface().mesh.triangles[f]) {
                if (length[v] < even_edge) {
                    more += area / 3 * (1 / (length[v] * length[v]) - 1 / (even_edge * even_edge));
                } else {
                    others += area / 3 / (even_edge * even_edge);
                }
            }
        }
        EXPECT_GT(more, 0);
        EXPECT_LE(more, 0.25 * others);
    }
}
