// The diagram is a valid cell complex for any relays: random meshes that are hard for geodesics,
// symmetric ones that are full of ties, all engines.
//
// AGVD_LONG=1 asks for more cases. AGVD_SEED=N runs case N alone, as in
//     AGVD_SEED=17 property_diagram --gtest_filter='*needles'

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numbers>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "support/checks.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

const std::vector<PropagationOptions>& settings() {
    static const std::vector<PropagationOptions> all{
        {.engine = Engine::Steiner, .steiner_points = 0},
        {.engine = Engine::Steiner, .steiner_points = 3},
        {.engine = Engine::Steiner, .steiner_points = 8},
        {.engine = Engine::Window, .max_error = 0.0},
        {.engine = Engine::Window, .max_error = 1e-3},
        {.engine = Engine::Window, .max_error = 1e-2}};
    return all;
}

void expect_valid(const Surface& surface, const std::vector<SurfacePoint>& sites) {
    for (PropagationOptions options : settings()) {
        SCOPED_TRACE(std::string(engine_name(options.engine)) +
                     " m=" + std::to_string(options.steiner_points) +
                     " E=" + std::to_string(options.max_error.value_or(-1)));
        options.num_threads = 1;
        const Propagation propagation = propagate(surface, sites, options);
        checks::expect_valid_complex(
            surface, build_diagram(surface, sites, propagation, {.num_threads = 1}));
        if (testing::Test::HasFailure()) return;
    }
}

// The case that oracle_engines makes of this seed.
void expect_valid_case(const char* family, std::uint64_t seed) {
    const TriangleMesh mesh = random_meshes::make(family, seed);
    Dice dice(seed + (std::uint64_t{1} << 32));
    const auto num_faces = static_cast<Index>(mesh.triangles.size());
    const auto sites = points::random_sites(dice, num_faces);
    SCOPED_TRACE(std::string(family) + " AGVD_SEED=" + std::to_string(seed) + ", " +
                 std::to_string(num_faces) + " faces, " + std::to_string(sites.size()) + " sites");
    expect_valid(build_surface(mesh.view()), sites);
}

class Complex : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(RandomMeshes, Complex, testing::ValuesIn(random_meshes::families()),
                         [](const auto& test) { return test.param; });

TEST_P(Complex, IsValid) {
    const char* const one = std::getenv("AGVD_SEED");
    const bool is_long = std::getenv("AGVD_LONG") != nullptr;
    const std::size_t num_cases = ((is_long ? 2000 : 200) - 1) / random_meshes::families().size();
    const std::uint64_t first = one != nullptr ? std::stoull(one) : 0;
    const std::uint64_t last = one != nullptr ? first : num_cases;
    for (std::uint64_t seed = first; seed <= last && !HasFailure(); ++seed) {
        expect_valid_case(GetParam(), seed);
    }
}

// Cases in which nearly tied labels made islands, or arcs between them.
TEST(Complex, IsValidWhereSitesNearlyTie) {
    const std::pair<const char*, std::uint64_t> cases[] = {
        {"stacked", 29},    {"stacked", 89},     {"stacked", 163},         {"stacked", 269},
        {"components", 93}, {"components", 460}, {"components", 682},      {"prism", 543},
        {"prism", 597},     {"saddle", 612},     {"reflex_boundary", 183}, {"solid", 528}};
    for (const auto& [family, seed] : cases) expect_valid_case(family, seed);
}

// --- Ties ----------------------------------------------------------------------------------------

struct Symmetric {
    const char* name;
    TriangleMesh (*make)();
};

TriangleMesh octahedron() {
    return {
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

// A regular prism with its axis along z, closed by fans around a vertex in the middle.
TriangleMesh prism() {
    constexpr Index n = 6;
    TriangleMesh mesh;
    for (const double z : {0.0, 1.0}) {
        for (Index i = 0; i < n; ++i) {
            const double u = 2 * std::numbers::pi * i / n;
            mesh.positions.emplace_back(std::cos(u), std::sin(u), z);
        }
    }
    mesh.positions.emplace_back(0, 0, 0);
    mesh.positions.emplace_back(0, 0, 1);
    for (Index i = 0; i < n; ++i) {
        const Index j = (i + 1) % n;
        mesh.triangles.insert(
            mesh.triangles.end(),
            {{i, j, n + j}, {i, n + j, n + i}, {j, i, 2 * n}, {n + i, n + j, 2 * n + 1}});
    }
    return mesh;
}

const Symmetric symmetric[] = {
    {"grid", [] { return shapes::grid(6); }},
    {"cube", shapes::cube},
    {"subdivided_cube", [] { return shapes::subdivide(shapes::subdivide(shapes::cube())); }},
    {"prism", prism},
    {"tetrahedron", shapes::tetrahedron},
    {"octahedron", octahedron},
    {"subdivided_octahedron", [] { return shapes::subdivide(octahedron()); }},
    {"icosahedron", shapes::icosahedron},
    {"sphere", [] { return shapes::sphere(2); }},
    {"torus", [] { return shapes::torus(12, 6); }},
    {"tube", [] { return shapes::tube(8, 4); }},
};

class Ties : public testing::TestWithParam<Symmetric> {
protected:
    Surface surface = build_surface(GetParam().make().view());

    // Tests sets of points, each tied with others by some symmetry.
    void expect_valid_from(const std::vector<SurfacePoint>& points) {
        for (const std::size_t step : {1u, 2u, 3u, 5u, 11u}) {
            std::vector<SurfacePoint> sites;
            for (std::size_t i = 0; i < points.size(); i += step) sites.push_back(points[i]);
            SCOPED_TRACE(std::to_string(sites.size()) + " sites");
            expect_valid(surface, sites);
            if (HasFailure()) return;
        }
    }
};

INSTANTIATE_TEST_SUITE_P(Symmetric, Ties, testing::ValuesIn(symmetric),
                         [](const auto& test) { return test.param.name; });

TEST_P(Ties, AtVerticesAreValid) {
    std::vector<SurfacePoint> points;
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        points.push_back(point_at(surface, v));
    }
    expect_valid_from(points);
}

TEST_P(Ties, AtEdgeMiddlesAreValid) {
    std::vector<SurfacePoint> points;
    for (const Index h : surface.edge_half) {
        SurfacePoint point{FaceId(Surface::face(h)), {0.5, 0.5, 0.5}};
        point.barycentric[(h + 2) % 3] = 0;
        points.push_back(point);
    }
    expect_valid_from(points);
}

TEST_P(Ties, AtFaceCentresAreValid) {
    std::vector<SurfacePoint> points;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        points.push_back({FaceId(f), {1.0 / 3, 1.0 / 3, 1.0 / 3}});
    }
    expect_valid_from(points);
}

// Three in every face: more sites than faces.
TEST_P(Ties, AroundFaceCentresAreValid) {
    std::vector<SurfacePoint> points;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            points.push_back({FaceId(f), {0.25, 0.25, 0.25}});
            points.back().barycentric[k] = 0.5;
        }
    }
    expect_valid_from(points);
}

// Every pair of vertices: antipodal ones, neighbours, and all others.
TEST_P(Ties, OfTwoSitesAreValid) {
    const Index stride = surface.num_vertices() > 30 ? 7 : 1;
    for (Index v = stride; v < surface.num_vertices() && !HasFailure(); v += stride) {
        SCOPED_TRACE("vertices 0 and " + std::to_string(v));
        expect_valid(surface, {point_at(surface, 0), point_at(surface, v)});
    }
}

// Three cells meet at a mesh vertex that each reaches at the same distance: the Voronoi vertex lies
// there, not somewhere in a face.
TEST(TiesAtVertices, OfThreeSitesAtAMeshVertexMeetThere) {
    const Surface surface = build_surface(octahedron().view());
    const std::vector<SurfacePoint> sites{point_at(surface, 0), point_at(surface, 2),
                                          point_at(surface, 1)};
    const Vec3 poles[] = {surface.mesh.positions[4], surface.mesh.positions[5]};
    for (const PropagationOptions& options : settings()) {
        const Diagram diagram = build_diagram(surface, sites, propagate(surface, sites, options));
        for (const Vec3& pole : poles) {
            const auto lies_there = [&](const SurfacePoint& vertex) {
                return (position(surface.mesh.view(), vertex) - pole).norm() < 1e-9;
            };
            EXPECT_TRUE(std::any_of(diagram.vertices.begin(), diagram.vertices.end(), lies_there))
                << engine_name(options.engine);
        }
    }
}

}  // namespace
