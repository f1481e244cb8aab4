// The diagram is a valid cell complex, and the same for any thread count and lambda.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <utility>

#include "agvd/core/random.h"
#include "agvd/diagram/diagram.h"
#include "agvd/propagation/propagate.h"
#include "support/checks.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// Vertex, edge and face sites in turn; some share a face.
std::vector<SurfacePoint> random_sites(const TriangleMesh& mesh, Index count, std::uint64_t seed) {
    std::vector<SurfacePoint> sites;
    for (Index i = 0; i < count; ++i) {
        const auto face = static_cast<Index>(random_bits(seed, 0, i) % mesh.triangles.size());
        const double u = 0.1 + 0.4 * random_unit(seed, 1, i);
        const double v = 0.1 + 0.4 * random_unit(seed, 2, i);
        SurfacePoint site{FaceId(face), {u, v, 1 - u - v}};
        if (i % 3 == 0) site.barycentric = {0, 1, 0};
        if (i % 3 == 1) site.barycentric = {u, 0, 1 - u};
        sites.push_back(site);
    }
    return sites;
}

struct Case {
    const char* name;
    TriangleMesh mesh;
};

std::vector<Case> cases() {
    std::vector<Case> result;
    result.push_back({"sphere", shapes::sphere(3)});
    result.push_back({"jittered sphere", shapes::jitter(shapes::sphere(3), 0.05, 3)});
    result.push_back({"torus", shapes::torus(24, 12)});
    result.push_back({"grid", shapes::grid(10)});
    result.push_back({"jittered grid", shapes::jitter(shapes::grid(12), 0.02, 5)});
    result.push_back({"tube", shapes::tube(16, 8)});
    result.push_back({"cube", shapes::subdivide(shapes::subdivide(shapes::cube()))});
    result.push_back({"tetrahedron", shapes::tetrahedron()});
    result.push_back({"two", shapes::join(shapes::sphere(2), shapes::grid(5))});
    return result;
}

template <typename T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

// SurfacePoint has padding, so its fields are compared.
}  // namespace

TEST(Diagram, IsAValidComplexOnManyMeshesAndSiteSets) {
    // scripts/check-long sets AGVD_LONG.
    const bool is_long = std::getenv("AGVD_LONG") != nullptr;
    const std::uint64_t num_seeds = is_long ? 20 : 2;
    for (const Case& c : cases()) {
        const Surface surface = build_surface(c.mesh.view());
        for (const Index t : {1u, 2u, 3u, 7u, 40u, is_long ? 400u : 90u}) {
            for (const int m : {0, 1, 8}) {
                for (std::uint64_t seed = 0; seed < num_seeds; ++seed) {
                    SCOPED_TRACE(std::string(c.name) + " t=" + std::to_string(t) +
                                 " m=" + std::to_string(m) + " seed=" + std::to_string(seed));
                    const auto sites = random_sites(c.mesh, t, seed);
                    const auto propagation =
                        propagate(surface, sites, {.engine = Engine::Steiner, .steiner_points = m});
                    const auto diagram =
                        build_diagram(surface, sites, propagation, {.num_threads = 1});
                    checks::expect_valid_complex(surface, diagram);
                    if (HasFailure()) return;
                }
            }
        }
    }
}

TEST(Diagram, SameBytesForAnyThreadCountAndLambda) {
    const TriangleMesh mesh = shapes::jitter(shapes::sphere(4), 0.01, 3);
    const Surface surface = build_surface(mesh.view());
    const auto sites = random_sites(mesh, 50, 9);
    const auto propagation = propagate(surface, sites, {.engine = Engine::Steiner});
    const auto diagram = build_diagram(surface, sites, propagation, {.num_threads = 1});
    for (const double lambda : {0.01, 0.3, 100.0}) {
        const auto other = propagate(surface, sites, {.engine = Engine::Steiner, .lambda = lambda});
        EXPECT_TRUE(same_bytes(propagation.relays, other.relays));
        EXPECT_TRUE(same_bytes(propagation.vertex_distance, other.vertex_distance));
        EXPECT_TRUE(same_bytes(propagation.mixed_faces, other.mixed_faces));
    }
    for (const int threads : {2, 3, 8}) {
        const auto other = build_diagram(surface, sites, propagation, {.num_threads = threads});
        checks::expect_same(diagram, other);
    }
}

TEST(Diagram, APropagationThatIsGivenAwayGivesTheSameDiagramAndLosesItsRelays) {
    const TriangleMesh mesh = shapes::jitter(shapes::sphere(3), 0.05, 3);
    const Surface surface = build_surface(mesh.view());
    const auto sites = random_sites(mesh, 40, 4);
    auto propagation = propagate(surface, sites);
    ASSERT_GT(propagation.relays.size(), 100u);
    const auto diagram = build_diagram(surface, sites, propagation);
    ASSERT_GT(propagation.relays.size(), 100u);
    checks::expect_same(diagram, build_diagram(surface, sites, std::move(propagation)));
    EXPECT_EQ(propagation.relays.capacity(), 0u);  // NOLINT(bugprone-use-after-move)
}

TEST(Diagram, SmallerLambdaHoldsFewerSteinerPoints) {
    const TriangleMesh mesh = shapes::sphere(5);
    const Surface surface = build_surface(mesh.view());
    const auto sites = random_sites(mesh, 3, 2);
    const auto all = propagate(surface, sites, {.engine = Engine::Steiner, .lambda = 100});
    const auto few = propagate(surface, sites, {.engine = Engine::Steiner, .lambda = 0.1});
    EXPECT_LT(few.peak_bytes, all.peak_bytes / 2);
}

TEST(Diagram, PlaneSitesGiveThePlanarVoronoiDiagram) {
    const TriangleMesh mesh = shapes::grid(8);
    const Surface surface = build_surface(mesh.view());
    const auto sites = random_sites(mesh, 5, 4);
    const auto diagram =
        build_diagram(surface, sites,
                      propagate(surface, sites, {.engine = Engine::Steiner, .steiner_points = 12}));
    const auto distance = [&](const Vec3& p, SiteId s) {
        return (p - position(mesh.view(), sites[s.value()])).norm();
    };
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const VoronoiEdge& edge = diagram.edges[e];
        if (!edge.right.is_valid()) continue;
        for (Index i = diagram.edge_points[e]; i < diagram.edge_points[e + 1]; ++i) {
            const Vec3 p = position(mesh.view(), diagram.points[i]);
            EXPECT_NEAR(distance(p, edge.left), distance(p, edge.right), 0.01);
        }
    }
}

TEST(Diagram, AThousandSitesInTwelveFacesAreAValidComplex) {
    const bool is_long = std::getenv("AGVD_LONG") != nullptr;
    const TriangleMesh mesh = shapes::cube();
    const Surface surface = build_surface(mesh.view());
    for (const bool is_lattice : {false, true}) {
        SCOPED_TRACE(is_lattice ? "lattice" : "random");
        std::vector<SurfacePoint> sites;
        const int steps = is_long ? 30 : 14;
        for (Index f = 0; f < mesh.triangles.size(); ++f) {
            for (int i = 1; i < steps; ++i) {
                for (int j = 1; i + j < steps; ++j) {
                    const auto n = static_cast<Index>(sites.size());
                    double u = static_cast<double>(i) / steps;
                    double v = static_cast<double>(j) / steps;
                    if (!is_lattice) {
                        u = random_unit(1, 0, n);
                        v = (1 - u) * random_unit(1, 1, n);
                    }
                    sites.push_back({FaceId(f), {u, v, 1 - u - v}});
                }
            }
        }
        const auto diagram = build_diagram(surface, sites, propagate(surface, sites));
        checks::expect_valid_complex(surface, diagram);
        for (const double area : diagram.cell_area) EXPECT_GT(area, 0);
        for (const int euler : diagram.cell_euler) EXPECT_EQ(euler, 1);
    }
}

// Their distances to a corner are not 0, but rounding puts them there.
TEST(Diagram, SitesInAFaceMayRoundToItsCorners) {
    const Surface surface = build_surface(shapes::tetrahedron().view());
    for (std::size_t i = 0; i < 6; ++i) {
        const std::size_t k = i % 3;
        const double little = i < 3 ? 1e-25 : 1e-200;  // Its square is 0.
        std::vector<SurfacePoint> sites{{FaceId(0), {little, little, little}},
                                        {FaceId(0), {0.25, 0.25, 0.5}}};
        sites[0].barycentric[k] = 1;
        const Propagation propagation = propagate(surface, sites);
        const Diagram diagram = build_diagram(surface, sites, propagation);
        checks::expect_valid_complex(surface, diagram);
        EXPECT_EQ(diagram.nearest_site[surface.mesh.triangles[0][k]], SiteId(0));
        EXPECT_GT(diagram.cell_area[0], 0);
        EXPECT_GT(diagram.cell_area[1], 0);
    }
}

TEST(Diagram, ManySitesInAFaceOfAPlaneGiveThePlanarVoronoiDiagram) {
    const TriangleMesh mesh = shapes::grid(1);
    const Surface surface = build_surface(mesh.view());
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::vector<SurfacePoint> sites;
        std::vector<Vec3> places;
        for (Index i = 0; i < 500; ++i) {
            const double u = random_unit(seed, 0, i);
            const double v = (1 - u) * random_unit(seed, 1, i);
            sites.push_back({FaceId(i % 2), {u, v, 1 - u - v}});
            places.push_back(position(mesh.view(), sites.back()));
        }
        const auto diagram =
            build_diagram(surface, sites, propagate(surface, sites, {.max_error = 0.0}));
        for (Index v = 0; v < diagram.vertices.size(); ++v) {
            const Vec3 p = position(mesh.view(), diagram.vertices[v]);
            double least = std::numeric_limits<double>::infinity();
            for (const Vec3& place : places) least = std::min(least, (p - place).norm());
            EXPECT_NEAR(diagram.vertex_distance[v], least, 1e-9);
            for (Index i = diagram.vertex_offsets[v]; i < diagram.vertex_offsets[v + 1]; ++i) {
                const SiteId site = diagram.vertex_sites[i];
                if (!site.is_valid()) continue;
                EXPECT_NEAR((p - places[site.value()]).norm(), least, 1e-9);
            }
        }
    }
}

TEST(Diagram, AComponentWithoutASiteIsUnreached) {
    const TriangleMesh mesh = shapes::join(shapes::sphere(2), shapes::grid(5));
    const Surface surface = build_surface(mesh.view());
    const std::vector<SurfacePoint> sites{{FaceId(0), {1, 0, 0}}, {FaceId(9), {0.2, 0.3, 0.5}}};
    const auto diagram = build_diagram(surface, sites, propagate(surface, sites));
    const Index in_grid = mesh.triangles.back()[0];
    EXPECT_FALSE(diagram.nearest_site[in_grid].is_valid());
    EXPECT_TRUE(std::isinf(diagram.nearest_distance[in_grid]));
    checks::expect_valid_complex(surface, diagram);
}
