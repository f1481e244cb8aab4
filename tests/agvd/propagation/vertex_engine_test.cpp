// Distances, labels and relays of the vertex engine where the truth is known by formula.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "agvd/diagram/build_diagram.h"
#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "support/checks.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// Paths are sums of lengths in double.
constexpr double rounding = 1e-12;

Propagation run(const Surface& surface, const std::vector<SurfacePoint>& sites) {
    return propagate(surface, sites, {.engine = Engine::Vertex});
}

// The unit square, folded up and down like a screen along the columns of its grid.
TriangleMesh folded_grid(Index n) {
    TriangleMesh mesh = shapes::grid(n);
    for (Vec3& p : mesh.positions) {
        const double column = p.x() * n;
        const double within = std::abs(column - 2 * std::round(column / 2));
        p = {0.6 * p.x(), p.y(), 0.8 * within / n};
    }
    return mesh;
}

struct Deviation {
    double least = 0;  // Relative; negative: shorter than any path.
    double mean = 0;
    double worst = 0;
};

// Against straight lines between the corresponding points of `flat`.
Deviation error_on(const TriangleMesh& mesh, const TriangleMesh& flat,
                   const std::vector<SurfacePoint>& sites) {
    const Surface surface = build_surface(mesh.view());
    const Propagation p = run(surface, sites);
    Deviation error;
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        double exact = std::numeric_limits<double>::infinity();
        for (const SurfacePoint& site : sites) {
            exact = std::min(exact, (flat.positions[v] - position(flat.view(), site)).norm());
        }
        const double relative = exact > 0 ? p.vertex_distance[v] / exact - 1 : 0;
        error.least = std::min(error.least, relative);
        error.worst = std::max(error.worst, relative);
        error.mean += relative / surface.num_vertices();
    }
    return error;
}

struct Case {
    const char* name;
    TriangleMesh mesh;
};

std::vector<Case> cases() {
    TriangleMesh needles = shapes::jitter(shapes::grid(12), 0.01, 4);
    for (Vec3& p : needles.positions) p.y() *= 1e-4;
    return {{"sphere", shapes::sphere(3)},
            {"jittered sphere", shapes::jitter(shapes::sphere(3), 0.05, 3)},
            {"torus", shapes::torus(24, 12)},
            {"jittered grid", shapes::jitter(shapes::grid(12), 0.02, 5)},
            {"folded grid", folded_grid(10)},
            {"tube", shapes::tube(16, 8)},
            {"cube", shapes::subdivide(shapes::subdivide(shapes::cube()))},
            {"tetrahedron", shapes::tetrahedron()},
            {"needles", needles},
            {"two", shapes::join(shapes::sphere(2), shapes::grid(5))}};
}

}  // namespace

TEST(VertexEngine, IsExactOnAFlatSheetAroundASite) {
    const TriangleMesh flat = shapes::grid(6);
    for (const TriangleMesh& mesh : {flat, folded_grid(6)}) {
        const Surface surface = build_surface(mesh.view());
        const std::vector<SurfacePoint> starts{
            point_at(surface, 24), {FaceId(40), {0.2, 0.3, 0.5}}, {FaceId(31), {0, 0.4, 0.6}}};
        for (const SurfacePoint& site : starts) {
            const Deviation error = error_on(mesh, flat, {site});
            EXPECT_GE(error.least, -rounding);
            EXPECT_LT(error.mean, 2e-3);
        }
    }
}

TEST(VertexEngine, IsNeverBelowAStraightLineOnAFlatSheet) {
    for (const Index n : {1u, 7u, 40u}) {
        const TriangleMesh flat = shapes::grid(n);
        const Surface surface = build_surface(flat.view());
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            const auto sites = points::scattered(surface, 1 + 2 * static_cast<Index>(seed), seed);
            for (const TriangleMesh& mesh : {flat, folded_grid(n)}) {
                const Deviation error = error_on(mesh, flat, sites);
                EXPECT_GE(error.least, -rounding);
                EXPECT_LT(error.worst, 0.42);  // Along the edges: sqrt(2).
                EXPECT_LT(error.mean, 0.03);
            }
        }
    }
}

TEST(VertexEngine, KeepsTheContractOfPropagation) {
    for (const Case& c : cases()) {
        const Surface surface = build_surface(c.mesh.view());
        for (const Index t : {1u, 2u, 9u, 40u, 3 * surface.num_faces()}) {
            SCOPED_TRACE(std::string(c.name) + " t=" + std::to_string(t));
            const auto sites = points::scattered(surface, t, t);
            const Propagation p = run(surface, sites);
            EXPECT_TRUE(std::isinf(p.certified_error));
            ASSERT_EQ(p.relay_ranges.size(), p.mixed_faces.size());
            EXPECT_TRUE(std::is_sorted(p.mixed_faces.begin(), p.mixed_faces.end()));

            std::vector<bool> is_listed(surface.num_faces(), false);
            for (Index i = 0; i < p.mixed_faces.size(); ++i) {
                const Index face = p.mixed_faces[i];
                is_listed[face] = true;
                ASSERT_EQ(p.relay_ranges[i].begin, i == 0 ? 0 : p.relay_ranges[i - 1].end);
                const std::span<const Relay> relays = relays_of(p, i);
                for (const Relay& relay : relays) {
                    ASSERT_EQ(Surface::face(relay.half_edge), face);
                    EXPECT_LE(0, relay.begin);
                    EXPECT_LE(relay.begin, relay.end);
                    EXPECT_LE(relay.end, surface.length_of(relay.half_edge));
                    EXPECT_GE(relay.weight, 0);
                    EXPECT_LT(relay.site.value(), t);
                }
                std::vector<PlanarRelay> planar;
                append_planar(surface, relays, {}, planar);
                const auto corners = face_corners(surface, face);
                for (std::size_t k = 0; k < 3; ++k) {
                    const Index v = surface.mesh.triangles[face][k];
                    std::vector<PlanarRelay> nearest_ones;
                    std::copy_if(planar.begin(), planar.end(), std::back_inserter(nearest_ones),
                                 [site = p.vertex_site[v].value()](const PlanarRelay& relay) {
                                     return relay.site == site;
                                 });
                    EXPECT_LE(least_reach(nearest_ones, corners[k]).distance,
                              p.vertex_distance[v] * (1 + 1e-9) + 1e-15);
                }
            }
            for (Index f = 0; f < surface.num_faces(); ++f) {
                if (is_listed[f]) continue;
                const Triangle& corners = surface.mesh.triangles[f];
                EXPECT_EQ(p.vertex_site[corners[0]], p.vertex_site[corners[1]]);
                EXPECT_EQ(p.vertex_site[corners[0]], p.vertex_site[corners[2]]);
            }
            for (Index s = 0; s < t; ++s) {
                const Index face = sites[s].face.value();
                if (is_listed[face]) continue;
                EXPECT_EQ(p.vertex_site[surface.mesh.triangles[face][0]], SiteId(s));
            }
            if (HasFailure()) return;
        }
    }
}

TEST(VertexEngine, DiagramsOfItsRelaysAreValidComplexes) {
    for (const Case& c : cases()) {
        const Surface surface = build_surface(c.mesh.view());
        for (const Index t : {1u, 3u, 12u, 90u}) {
            SCOPED_TRACE(std::string(c.name) + " t=" + std::to_string(t));
            const auto sites = points::scattered(surface, t, t);
            const auto diagram =
                build_diagram(surface, sites, run(surface, sites), {.num_threads = 1});
            checks::expect_valid_complex(surface, diagram);
            if (HasFailure()) return;
        }
    }
}

TEST(VertexEngine, TheLowerSiteWinsTies) {
    const Index n = 8;
    const Surface surface = build_surface(shapes::grid(n).view());
    const auto vertex_near = [&](const Vec3& p) {
        Index best = 0;
        for (Index v = 1; v < surface.num_vertices(); ++v) {
            const auto& x = surface.mesh.positions;
            if ((x[v] - p).norm() < (x[best] - p).norm()) best = v;
        }
        return best;
    };
    const SurfacePoint left = point_at(surface, vertex_near({0, 0.5, 0}));
    const SurfacePoint right = point_at(surface, vertex_near({1, 0.5, 0}));
    for (const auto& sites : {std::vector{left, right}, std::vector{right, left}}) {
        const Propagation p = run(surface, sites);
        EXPECT_EQ(p.vertex_site[vertex_near({0.5, 0.5, 0})], SiteId(0));
    }
    // Two sites on one spot, whatever the spot.
    for (const SurfacePoint& spot :
         {left, SurfacePoint{FaceId(5), {0.2, 0.3, 0.5}}, SurfacePoint{FaceId(5), {0.5, 0.5, 0}}}) {
        const Propagation p = run(surface, {spot, spot, spot});
        for (const SiteId site : p.vertex_site) EXPECT_EQ(site, SiteId(0));
    }
}

TEST(VertexEngine, SeveralSitesInAFaceEachTakeTheirSide) {
    const Surface surface = build_surface(shapes::grid(4).view());
    const Index face = 12;
    std::vector<SurfacePoint> sites;
    for (std::size_t k = 0; k < 3; ++k) {
        SurfacePoint site{FaceId(face), {0.1, 0.1, 0.1}};
        site.barycentric[k] = 0.8;
        sites.push_back(site);
    }
    const Propagation p = run(surface, sites);
    for (Index k = 0; k < 3; ++k) {
        const Index v = surface.mesh.triangles[face][k];
        EXPECT_EQ(p.vertex_site[v], SiteId(k));
        const Vec3 at = position(surface.mesh.view(), sites[k]);
        EXPECT_NEAR(p.vertex_distance[v], (surface.mesh.positions[v] - at).norm(), 1e-14);
    }
}

TEST(VertexEngine, AComponentWithoutASiteIsUnreached) {
    const TriangleMesh mesh = shapes::join(shapes::sphere(2), shapes::grid(5));
    const Surface surface = build_surface(mesh.view());
    const Propagation p = run(surface, {{FaceId(0), {1, 0, 0}}, {FaceId(9), {0.2, 0.3, 0.5}}});
    Index reached = 0;
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        EXPECT_EQ(p.vertex_site[v].is_valid(), std::isfinite(p.vertex_distance[v]));
        if (p.vertex_site[v].is_valid()) ++reached;
    }
    EXPECT_EQ(reached, shapes::sphere(2).positions.size());
    EXPECT_EQ(p.num_nodes, reached);
    EXPECT_FALSE(p.vertex_site.back().is_valid());
    const Propagation none = run(surface, {});
    EXPECT_TRUE(none.mixed_faces.empty());
    EXPECT_FALSE(none.vertex_site.front().is_valid());
}

TEST(VertexEngine, BendsAroundAReflexCorner) {
    // An L: the unit square without its upper right quarter.
    TriangleMesh mesh = shapes::grid(8);
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        const Vec3 middle =
            (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3;
        return middle.x() > 0.5 && middle.y() > 0.5;
    });
    const Surface surface = build_surface(mesh.view());
    const auto vertex_at = [&](double x, double y) {
        for (Index v = 0;; ++v) {
            if ((mesh.positions[v] - Vec3(x, y, 0)).norm() < 1e-9) return v;
        }
    };
    const Propagation p = run(surface, {point_at(surface, vertex_at(0.5, 1))});
    const double bend = 0.5;
    EXPECT_NEAR(p.vertex_distance[vertex_at(0.5, 0.5)], bend, 1e-12);
    EXPECT_NEAR(p.vertex_distance[vertex_at(1, 0.5)], 2 * bend, 1e-12);
    EXPECT_NEAR(p.vertex_distance[vertex_at(0.75, 0.375)], bend + std::hypot(0.25, 0.125), 1e-12);
}

TEST(VertexEngine, DistancesScaleWithTheMesh) {
    for (const Case& c : cases()) {
        const Surface surface = build_surface(c.mesh.view());
        const auto sites = points::scattered(surface, 7, 3);
        const Propagation p = run(surface, sites);
        for (const int exponent : {-70, 70}) {
            SCOPED_TRACE(std::string(c.name) + " by 2^" + std::to_string(exponent));
            TriangleMesh scaled = c.mesh;
            for (Vec3& x : scaled.positions) x *= std::ldexp(1.0, exponent);
            const Propagation q = run(build_surface(scaled.view()), sites);
            EXPECT_EQ(p.vertex_site, q.vertex_site);
            for (Index v = 0; v < surface.num_vertices(); ++v) {
                ASSERT_EQ(std::ldexp(p.vertex_distance[v], exponent), q.vertex_distance[v]);
            }
        }
    }
}

TEST(VertexEngine, SameBytesForAnyThreadCount) {
    const TriangleMesh mesh = shapes::jitter(shapes::sphere(4), 0.01, 3);
    const Surface surface = build_surface(mesh.view());
    const auto sites = points::scattered(surface, 50, 9);
    const auto same = [](const auto& a, const auto& b) {
        return a.size() == b.size() &&
               std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
    };
    const Propagation one = propagate(surface, sites, {.engine = Engine::Vertex, .num_threads = 1});
    for (const int threads : {2, 3, 8}) {
        const Propagation other =
            propagate(surface, sites, {.engine = Engine::Vertex, .num_threads = threads});
        EXPECT_TRUE(same(one.vertex_distance, other.vertex_distance));
        EXPECT_TRUE(same(one.vertex_site, other.vertex_site));
        EXPECT_TRUE(same(one.mixed_faces, other.mixed_faces));
        EXPECT_TRUE(same(one.relay_ranges, other.relay_ranges));
        EXPECT_TRUE(same(one.relays, other.relays));
    }
}

TEST(VertexEngine, RefusesAnErrorBoundAndStopsWhenAsked) {
    const Surface surface = build_surface(shapes::grid(3).view());
    const std::vector<SurfacePoint> sites{{FaceId(0), {1, 0, 0}}};
    EXPECT_THROW((void)propagate(surface, sites, {.engine = Engine::Vertex, .max_error = 0.1}),
                 InvalidOption);
    EXPECT_THROW(
        (void)propagate(surface, sites,
                        {.engine = Engine::Vertex, .progress = [](double) { return false; }}),
        Cancelled);
    EXPECT_THROW((void)run(surface, {{FaceId(1000), {1, 0, 0}}}), InvalidInput);
}
