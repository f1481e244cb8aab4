// Results whose edges follow target lengths.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "agvd/core/error.h"
#include "agvd/mesh/scale.h"
#include "agvd/mesh/topology.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"
#include "support/dirty_shapes.h"
#include "support/parts.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Triangle;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::AdaptiveEdges;
using remesh::CountOfLengths;
using remesh::FaceLengths;
using remesh::MeanEdge;
using remesh::NumFaces;
using remesh::RemeshOptions;
using remesh::RemeshResult;
using remesh::VertexDensities;
using remesh::VertexLengths;

namespace {

constexpr double tube = 0.35;

// Tenfold from one side of a torus to the other.
double tenfold(const Vec3& at) {
    return std::pow(10, (1 - std::cos(std::atan2(at.y(), at.x()))) / 2);
}

std::vector<double> values_of(const TriangleMesh& mesh) {
    std::vector<double> values;
    for (const Vec3& p : mesh.positions) values.push_back(tenfold(p));
    return values;
}

// 5th and 95th percentile of the edges over factor times the field at their middles.
std::pair<double, double> percentiles(const TriangleMesh& mesh, double factor) {
    std::vector<double> ratios;
    for (const agvd::Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 &a = mesh.positions[t[k]], &b = mesh.positions[t[(k + 1) % 3]];
            ratios.push_back((a - b).norm() / (factor * tenfold((a + b) / 2)));
        }
    }
    std::sort(ratios.begin(), ratios.end());
    return {ratios[ratios.size() / 20], ratios[ratios.size() * 19 / 20]};
}

// The factor at which the field needs this number of vertices.
double factor_for(const TriangleMesh& mesh, double count) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 &p = mesh.positions[a], &q = mesh.positions[b], &r = mesh.positions[c];
        const double length = tenfold((p + q + r) / 3);
        sum += (q - p).cross(r - p).norm() / 2 / (length * length);
    }
    return std::sqrt(2 / std::sqrt(3.) * sum / count);
}

double mean_edge(const TriangleMesh& mesh) {  // Closed.
    double sum = 0;
    for (const agvd::Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            sum += (mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]]).norm();
        }
    }
    return sum / (3 * static_cast<double>(mesh.triangles.size()));
}

}  // namespace

TEST(Sizing, EdgesFollowAFieldThatVariesTenfold) {
    const TriangleMesh mesh = shapes::torus(160, 64, tube);
    for (const auto& [is_density, init] :
         {std::pair(false, remesh::Init::BlueNoise), {true, remesh::Init::Farthest}}) {
        RemeshOptions options{.num_samples = 2000, .init = init};
        std::vector<double> values = values_of(mesh);
        if (is_density) {
            for (double& value : values) value = 7 / (value * value);
            options.sizing.edges = VertexDensities{values};
        } else {
            options.sizing.edges = VertexLengths{values};
        }
        const RemeshResult result = remesh::remesh(mesh.view(), options);
        EXPECT_EQ(result.mesh.positions.size(), 2000u);
        EXPECT_EQ(remesh::analyze_topology(result.mesh.view()).genus(), 1);
        const auto [low, high] = percentiles(result.mesh, factor_for(mesh, 2000));
        EXPECT_GT(low, 0.8);
        EXPECT_LT(high, 1.28);
        EXPECT_NEAR(result.sizing.low_ratio, low, 0.05);
        EXPECT_NEAR(result.sizing.high_ratio, high, 0.05);
        EXPECT_NEAR(result.sizing.largest_target / result.sizing.least_target, 10, 0.8);
        const std::vector<double>& targets = result.sizing.targets;
        ASSERT_EQ(targets.size(), result.mesh.positions.size());
        EXPECT_EQ(*std::max_element(targets.begin(), targets.end()), result.sizing.largest_target);
    }
}

TEST(Sizing, AFieldOnBoundaryAndCreasesIsFollowedThere) {
    // One row of triangles along each crease: lengths vary within edges of the input.
    const TriangleMesh box = parts::open_box({4, 1, 1}, 2);
    std::vector<double> lengths;
    for (const Vec3& p : box.positions) lengths.push_back(0.05 + 0.25 * p.x() / 4);
    const RemeshResult result = remesh::remesh(
        box.view(), {.num_samples = 900, .sizing = {.edges = VertexLengths{lengths}}});
    EXPECT_EQ(result.mesh.positions.size(), 900u);
    EXPECT_GT(result.sizing.low_ratio, 0.72);
    EXPECT_LT(result.sizing.high_ratio, 1.36);
    // Along the edge y = z = 1 there are as many vertices as the field asks for.
    const double factor = result.sizing.largest_target / 0.3;
    double count = 0;
    for (const Vec3& p : result.mesh.positions) {
        if (std::abs(p.y() - 1) < 1e-9 && std::abs(p.z() - 1) < 1e-9) ++count;
    }
    EXPECT_NEAR(count, std::log(6.) / (factor * 0.0625) + 1, 3);
    EXPECT_NEAR(result.features.dropped_length, 0, 0);
}

TEST(Sizing, EqualLengthsGiveTheBytesOfNone) {
    const TriangleMesh plate = parts::box({4, 3, 0.05}, 8);
    RemeshOptions options{.num_samples = 400};
    const RemeshResult none = remesh::remesh(plate, options);
    const std::size_t num_vertices = plate.positions.size(), num_faces = plate.triangles.size();
    for (const auto& edges :
         {decltype(options.sizing.edges){VertexLengths{std::vector<double>(num_vertices, 0.7)}},
          {FaceLengths{std::vector<double>(num_faces, 0.7)}},
          {VertexDensities{std::vector<double>(num_vertices, 3)}}}) {
        options.sizing.edges = edges;
        const RemeshResult equal = remesh::remesh(plate, options);
        EXPECT_EQ(equal.mesh.positions, none.mesh.positions);
        EXPECT_EQ(equal.mesh.triangles, none.mesh.triangles);
    }
}

TEST(Sizing, LengthsKeepTheCreasesThatNoneKeep) {
    const TriangleMesh plate = parts::box({4, 3, 0.05}, 8);
    RemeshOptions options{.num_samples = 800};
    const double rims = remesh::remesh(plate, options).features.length;
    EXPECT_NEAR(rims, 28.2, 0.1);  // Both, with a strip between them, and the four short edges.
    for (const bool gives_number : {false, true}) {
        std::vector<double> lengths;
        for (const Vec3& p : plate.positions) lengths.push_back(0.17 + 0.03 * p.x() / 4);
        options.sizing.edges = VertexLengths{lengths};
        if (gives_number) options.sizing.count = CountOfLengths{};
        const RemeshResult result = remesh::remesh(plate, options);
        EXPECT_EQ(result.features.length, rims);
        EXPECT_EQ(result.self_intersections.value_or(0), 0u);
    }
}

TEST(Sizing, CreasesAreCloseByTheLengthsThere) {
    const TriangleMesh plate = parts::box({4, 3, 0.05}, 8);
    // With a mean edge given there are no strips.
    RemeshOptions options;
    options.sizing.count = MeanEdge{0.165};
    EXPECT_NEAR(remesh::remesh(plate, options).features.length, 14, 1e-9);
    std::vector<double> lengths;
    for (const Vec3& p : plate.positions) lengths.push_back(p.x() < 2 ? 0.3 : 0.1);
    options.sizing.edges = VertexLengths{lengths};
    // And half of the second rim.
    EXPECT_NEAR(remesh::remesh(plate, options).features.length, 21, 0.8);
}

TEST(Sizing, LengthsGiveTheNumber) {
    const TriangleMesh mesh = shapes::torus(160, 64, tube);
    std::vector<double> lengths = values_of(mesh);
    for (double& length : lengths) length *= 0.04;
    const RemeshOptions options{
        .sizing = {.edges = VertexLengths{lengths}, .count = CountOfLengths{}}};
    const RemeshResult result = remesh::remesh(mesh.view(), options);
    const double factor = factor_for(mesh, static_cast<double>(result.mesh.positions.size()));
    EXPECT_NEAR(factor, 0.04, 0.0015);
    EXPECT_EQ(result.sizing.num_samples, result.mesh.positions.size());
}

TEST(Sizing, FacesHaveLengths) {
    const TriangleMesh mesh = shapes::torus(80, 40);
    FaceLengths lengths;
    for (const Triangle& t : mesh.triangles) {
        lengths.values.push_back(mesh.positions[t[0]].x() > 0 ? 0.05 : 0.15);
    }
    const RemeshOptions options{
        .sizing = {.edges = lengths, .count = CountOfLengths{}, .gradation = 10}};
    const RemeshResult result = remesh::remesh(mesh.view(), options);
    std::array<double, 2> sum{}, count{};  // Of edges far from the border, by length.
    for (const Triangle& t : result.mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& from = result.mesh.positions[t[k]];
            if (std::abs(from.x()) < 0.8) continue;
            const std::size_t side = from.x() > 0 ? 0 : 1;
            sum[side] += (result.mesh.positions[t[(k + 1) % 3]] - from).norm();
            ++count[side];
        }
    }
    EXPECT_NEAR(sum[0] / count[0], 0.05, 0.005);
    EXPECT_NEAR(sum[1] / count[1], 0.15, 0.015);
}

TEST(Sizing, EdgesHaveTheMeanLengthAskedFor) {
    Index num_tried = 0;
    for (const TriangleMesh& mesh :
         {shapes::sphere(4), shapes::torus(90, 40), parts::box({1, 1, 1}, 8)}) {
        for (const bool is_adaptive : {false, true}) {
            for (const int steps : {0, 60}) {
                RemeshOptions options{.sizing = {.count = MeanEdge{0.09}}, .relax_steps = steps};
                if (is_adaptive) options.sizing.edges = AdaptiveEdges{};
                const RemeshResult result = remesh::remesh(mesh.view(), options);
                EXPECT_NEAR(mean_edge(result.mesh) / 0.09, 1, 0.012);
                EXPECT_NEAR(result.sizing.mean_edge, mean_edge(result.mesh), 1e-12);
                EXPECT_EQ(result.sizing.num_samples, result.mesh.positions.size());
                ++num_tried;
            }
        }
    }
    EXPECT_EQ(num_tried, 12u);
}

TEST(Sizing, ANumberOfFacesComesOut) {
    const auto faces_of = [](const TriangleMesh& mesh, Index num_faces) {
        return remesh::remesh(mesh.view(), {.sizing = {.count = NumFaces{num_faces}}})
            .mesh.triangles.size();
    };
    EXPECT_EQ(faces_of(shapes::sphere(3), 600), 600u);
    EXPECT_EQ(faces_of(shapes::torus(60, 30), 600), 600u);
    EXPECT_EQ(
        faces_of(shapes::join(shapes::sphere(3), shapes::moved(shapes::sphere(3), {3, 0, 0})), 600),
        600u);
    EXPECT_NEAR(static_cast<double>(faces_of(shapes::grid(20), 600)), 600, 12);
    EXPECT_NEAR(static_cast<double>(faces_of(shapes::tube(60, 30), 900)), 900, 18);
}

TEST(Sizing, AdaptiveEdgesAreShortWhereTheSurfaceIsCurved) {
    const TriangleMesh mesh = shapes::torus(200, 80, 0.2);
    TriangleMesh bent = mesh;  // Thicker on the side of x > 0.
    for (Vec3& p : bent.positions) {
        const double around = std::hypot(p.x(), p.y());
        const Vec3 middle = Vec3(p.x(), p.y(), 0) / around;
        p = middle + (1.8 + 1.4 * middle.x()) * (p - middle);
    }
    const RemeshResult uniform = remesh::remesh(bent.view(), {.num_samples = 1200});
    const RemeshResult adaptive =
        remesh::remesh(bent.view(), {.num_samples = 1200, .sizing = {.edges = AdaptiveEdges{}}});
    EXPECT_EQ(adaptive.mesh.positions.size(), 1200u);
    EXPECT_GT(adaptive.sizing.largest_target, 2 * adaptive.sizing.least_target);
    const auto num_thin = [](const TriangleMesh& of) {
        return std::count_if(of.positions.begin(), of.positions.end(),
                             [](const Vec3& p) { return p.x() < -0.7; });
    };
    EXPECT_GT(static_cast<double>(num_thin(adaptive.mesh)),
              1.5 * static_cast<double>(num_thin(uniform.mesh)));
    const auto apart = [&](const RemeshResult& result) {
        return remesh::surface_distance(bent.view(), result.mesh.view(), {.samples = 20'000});
    };
    const auto of_uniform = apart(uniform), of_adaptive = apart(adaptive);
    if (!of_uniform) GTEST_SKIP() << "distances need CGAL";
    EXPECT_LT(of_adaptive->two_sided().rms, of_uniform->two_sided().rms);
}

TEST(Sizing, ThreadsChangeNothing) {
    const TriangleMesh torus = shapes::torus(80, 40, tube);
    const TriangleMesh box = parts::open_box({2, 1, 1}, 6);
    Index num_tried = 0;
    for (const TriangleMesh* mesh : {&torus, &box}) {
        for (const bool is_adaptive : {false, true}) {
            for (const remesh::Init init : {remesh::Init::BlueNoise, remesh::Init::Random}) {
                RemeshOptions options{.num_samples = 500, .init = init};
                options.sizing.edges = AdaptiveEdges{};
                if (!is_adaptive) options.sizing.edges = VertexLengths{values_of(*mesh)};
                options.num_threads = 1;
                const RemeshResult one = remesh::remesh(mesh->view(), options);
                options.num_threads = 4;
                const RemeshResult more = remesh::remesh(mesh->view(), options);
                EXPECT_EQ(more.mesh.positions, one.mesh.positions);
                EXPECT_EQ(more.mesh.triangles, one.mesh.triangles);
                ++num_tried;
            }
        }
    }
    EXPECT_EQ(num_tried, 8u);
}

TEST(Sizing, LengthsFollowVerticesThatAreWelded) {
    const TriangleMesh mesh = shapes::torus(80, 40, tube);
    const TriangleMesh soup = shapes::unweld(mesh);
    const RemeshResult result = remesh::remesh(
        soup.view(), {.num_samples = 800, .sizing = {.edges = VertexLengths{values_of(soup)}}});
    const auto [low, high] = percentiles(result.mesh, factor_for(mesh, 800));
    EXPECT_GT(low, 0.75);
    EXPECT_LT(high, 1.35);
}

TEST(Sizing, LengthsAreScaledWithTheMesh) {
    const TriangleMesh mesh = shapes::torus(60, 30, tube);
    const int exponent = 200;
    RemeshOptions options{.num_samples = 300};
    std::vector<double> lengths = values_of(mesh);
    options.sizing = {.edges = VertexLengths{lengths}, .min_edge = 0.05, .max_edge = 0.4};
    const RemeshResult result = remesh::remesh(mesh.view(), options);
    for (double& length : lengths) length = std::ldexp(length, exponent);
    options.sizing.edges = VertexLengths{lengths};
    options.sizing.min_edge = std::ldexp(0.05, exponent);
    options.sizing.max_edge = std::ldexp(0.4, exponent);
    const RemeshResult large = remesh::remesh(agvd::scaled(mesh.view(), exponent).view(), options);
    EXPECT_EQ(large.mesh.positions, agvd::scaled(result.mesh.view(), exponent).positions);
    EXPECT_EQ(large.sizing.mean_edge, std::ldexp(result.sizing.mean_edge, exponent));
    EXPECT_EQ(large.sizing.least_target, std::ldexp(result.sizing.least_target, exponent));
    EXPECT_EQ(large.sizing.targets.at(0), std::ldexp(result.sizing.targets.at(0), exponent));
}

TEST(Sizing, WrongOptionsAreRefused) {
    const TriangleMesh mesh = shapes::sphere(2);
    const std::vector<double> ones(mesh.positions.size(), 1);
    std::vector<double> negative = ones, infinite = ones;
    negative[5] = -1;
    infinite[3] = std::numeric_limits<double>::infinity();
    const remesh::Sizing wrong[] = {
        {.edges = VertexLengths{{1, 2}}},
        {.edges = VertexLengths{negative}},
        {.edges = VertexDensities{infinite}},
        {.count = remesh::MaxError{0.1}},
        {.count = CountOfLengths{}},
        {.edges = VertexDensities{ones}, .count = CountOfLengths{}},
        {.min_edge = 2, .max_edge = 1},
        {.gradation = 0.9},
        {.count = MeanEdge{-1}},
        {.count = MeanEdge{1e-9}},
        {.count = NumFaces{0}},
    };
    for (const remesh::Sizing& sizing : wrong) {
        EXPECT_THROW((void)remesh::remesh(mesh.view(), {.sizing = sizing}), agvd::InvalidOption);
    }
}

namespace {

// The mean edge of the triangles whose corners all lie in a box.
double mean_edge_in(const TriangleMesh& mesh, const agvd::MeshBox& box) {
    double sum = 0, count = 0;
    for (const Triangle& t : mesh.triangles) {
        const bool is_inside = std::ranges::all_of(t, [&](Index v) {
            const Vec3& p = mesh.positions[v];
            return (p.array() >= box.low.array()).all() && (p.array() <= box.high.array()).all();
        });
        for (std::size_t k = 0; is_inside && k < 3; ++k) {
            sum += (mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]]).norm();
            ++count;
        }
    }
    return sum / count;
}

agvd::MeshBox box_around(const Vec3& middle, double reach) {
    agvd::MeshBox box;
    box.add(middle - Vec3::Constant(reach));
    box.add(middle + Vec3::Constant(reach));
    return box;
}

// A plate of 2 x 2 whose sides are .02 apart, and the vertex in the middle of its top.
std::pair<TriangleMesh, Index> plate_and_middle() {
    TriangleMesh plate = parts::box({1, 1, 1}, 16);
    Index middle = 0;
    double least = 1e9;
    for (Index v = 0; v < plate.positions.size(); ++v) {
        Vec3& p = plate.positions[v];
        p = p.cwiseProduct(Vec3(2, 2, 0.02));
        const double distance = (p - Vec3(1, 1, 0.02)).norm();
        if (distance < least) middle = v;
        least = std::min(least, distance);
    }
    return {std::move(plate), middle};
}

}  // namespace

// Edges grow along the surface: those on the other side of the plate stay long.
TEST(Sizing, PlacesShortenEdgesOnTheirSideOfAWall) {
    const auto [plate, middle] = plate_and_middle();
    const agvd::Surface surface = agvd::build_surface(plate.view());
    const Vec3 top = plate.positions[middle];
    remesh::SizedPlace place{.points = {agvd::point_at(surface, middle)}, .length = 0.03};
    for (const double radius : {0.0, 0.25}) {
        place.radius = radius;
        const RemeshOptions options{.num_samples = 1500, .sizing = {.places = {place}}};
        const RemeshResult result = remesh::remesh(plate.view(), options);
        EXPECT_EQ(result.mesh.positions.size(), 1500u);
        const agvd::MeshBox near = box_around(top + Vec3(0, 0, 0.015), radius > 0 ? 0.2 : 0.1);
        agvd::MeshBox above = near;
        above.low.z() = 0.011;
        const double on_top = mean_edge_in(result.mesh, above);
        EXPECT_GT(on_top, 0.027);
        EXPECT_LT(on_top, radius > 0 ? 0.036 : 0.06);
        agvd::MeshBox below = box_around(top - Vec3(0, 0, 0.02), 0.4);
        below.high.z() = 0.009;
        EXPECT_GT(mean_edge_in(result.mesh, below), 0.08);
    }
}

TEST(Sizing, PlacesAreLinesAndRegions) {
    const TriangleMesh grid = shapes::grid(16);  // Of the unit square.
    const Index edge = 7;
    const auto result_for = [&](const remesh::SizedPlace& place) {
        return remesh::remesh(grid.view(), {.num_samples = 600, .sizing = {.places = {place}}});
    };
    const Triangle& t = grid.triangles[edge];
    const Vec3 &a = grid.positions[t[0]], &b = grid.positions[t[1]];
    const Vec3 middle = (a + b) / 2;
    const double even = remesh::remesh(grid.view(), {.num_samples = 600}).sizing.mean_edge;
    for (const remesh::SizedPlace& place :
         {remesh::SizedPlace{.edges = {{t[1], t[0]}}, .length = 0.3 * even},
          remesh::SizedPlace{.faces = {edge}, .length = 0.3 * even}}) {
        const RemeshResult result = result_for(place);
        EXPECT_NEAR(result.sizing.least_target, 0.3 * even, 0.02 * even);
        EXPECT_LT(mean_edge_in(result.mesh, box_around(middle, 1.2 * even)), 0.6 * even);
    }
    EXPECT_THROW((void)result_for({.edges = {{0, 289 - 1}}, .length = 0.1}), agvd::InvalidInput);
    EXPECT_THROW((void)result_for({.faces = {9999}, .length = 0.1}), agvd::InvalidInput);
    EXPECT_THROW((void)result_for({.faces = {0}}), agvd::InvalidOption);
    EXPECT_THROW((void)result_for({.faces = {0}, .length = 1, .radius = -1}), agvd::InvalidOption);
    RemeshOptions wrapped{.sizing = {.places = {{.faces = {0}, .length = 0.1}}}};
    wrapped.wrap = 0;
    EXPECT_THROW((void)remesh::remesh(grid.view(), wrapped), agvd::InvalidOption);
}

TEST(Sizing, PlacesScaleWithTheMesh) {
    const TriangleMesh ball = shapes::sphere(4);
    const agvd::Surface surface = agvd::build_surface(ball.view());
    const RemeshOptions options{
        .num_samples = 400,
        .sizing = {
            .places = {{.points = {agvd::point_at(surface, 5)}, .length = 0.05, .radius = 0.2}}}};
    const RemeshResult one = remesh::remesh(ball.view(), options);
    EXPECT_GT(one.sizing.low_ratio, 0.6);
    EXPECT_LT(one.sizing.high_ratio, 1.45);
    RemeshOptions large = options;
    large.sizing.places[0].length = std::ldexp(0.05, 700);
    large.sizing.places[0].radius = std::ldexp(0.2, 700);
    TriangleMesh scaled = ball;
    for (Vec3& p : scaled.positions) p *= std::ldexp(1, 700);
    const RemeshResult other = remesh::remesh(scaled.view(), large);
    EXPECT_EQ(one.mesh.triangles, other.mesh.triangles);
    EXPECT_NEAR(one.sizing.least_target, 0.05, 1e-3);
}
