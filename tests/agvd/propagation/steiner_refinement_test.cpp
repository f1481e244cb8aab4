// The Steiner engine with an error bound, against the window engine and against formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "agvd/diagram/diagram.h"
#include "agvd/propagation/propagate.h"
#include "support/checks.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

constexpr double sum_rounding = 1e-12;

struct RefinementCase {
    const char* name;
    TriangleMesh mesh;
};

std::vector<RefinementCase> refinement_cases() {
    TriangleMesh flat_faces = shapes::jitter(shapes::sphere(2), 0.02, 8);
    for (Vec3& p : flat_faces.positions) p.z() *= 0.1;
    return {{"jittered sphere", shapes::jitter(shapes::sphere(3), 0.03, 3)},
            {"torus", shapes::torus(24, 12)},
            {"jittered grid", shapes::jitter(shapes::grid(12), 0.02, 5)},
            {"tube", shapes::tube(16, 8)},
            {"cube", shapes::subdivide(shapes::cube())},
            {"flat faces", flat_faces},
            {"two", shapes::join(shapes::sphere(2), shapes::grid(5))}};
}

std::vector<double> exact_distances(const Surface& surface,
                                    const std::vector<SurfacePoint>& sites) {
    return propagate(surface, sites, {.engine = Engine::Window, .max_error = 0}).vertex_distance;
}

double worst_error(const std::vector<double>& distances, const std::vector<double>& exact) {
    double worst = 0;
    for (std::size_t v = 0; v < exact.size(); ++v) {
        if (std::isinf(exact[v])) {
            EXPECT_TRUE(std::isinf(distances[v]));
        } else if (exact[v] > 0) {
            EXPECT_GE(distances[v], exact[v] * (1 - sum_rounding));
            worst = std::max(worst, distances[v] / exact[v] - 1);
        } else {
            EXPECT_EQ(distances[v], 0);
        }
    }
    return worst;
}

template <typename T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

std::string refusal(const Surface& surface, const std::vector<SurfacePoint>& sites,
                    const PropagationOptions& options) {
    try {
        (void)propagate(surface, sites, options);
    } catch (const ConstraintUnmet& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST(SteinerRefinement, MeetsTheErrorOnManyMeshesAndSiteSets) {
    for (const RefinementCase& c : refinement_cases()) {
        const Surface surface = build_surface(c.mesh.view());
        for (const Index t : {1u, 5u, 60u}) {
            const auto sites = points::scattered(surface, t, t);
            const auto exact = exact_distances(surface, sites);
            for (const double max_error : {1e-2, 2e-3}) {
                for (const int m : {0, 3, 8}) {
                    SCOPED_TRACE(std::string(c.name) + " t=" + std::to_string(t) +
                                 " m=" + std::to_string(m) + " E=" + std::to_string(max_error));
                    const Propagation p = propagate(
                        surface, sites,
                        {.engine = Engine::Steiner, .max_error = max_error, .steiner_points = m});
                    EXPECT_LE(p.certified_error, max_error);
                    EXPECT_LE(worst_error(p.vertex_distance, exact), p.certified_error);
                    checks::expect_valid_complex(surface, build_diagram(surface, sites, p));
                    if (HasFailure()) return;
                }
            }
        }
    }
}

TEST(SteinerRefinement, IsNearStraightLinesOnAFlatSheet) {
    constexpr double max_error = 1e-3;
    const TriangleMesh mesh = shapes::grid(9);
    const Surface surface = build_surface(mesh.view());
    const SurfacePoint site{FaceId(40), {0.2, 0.3, 0.5}};
    const Propagation p =
        propagate(surface, std::vector{site}, {.engine = Engine::Steiner, .max_error = max_error});
    const Vec3 start = position(mesh.view(), site);
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        const double exact = (mesh.positions[v] - start).norm();
        EXPECT_GE(p.vertex_distance[v], exact * (1 - sum_rounding));
        EXPECT_LE(p.vertex_distance[v], exact * (1 + max_error));
    }
}

TEST(SteinerRefinement, TakesFewerPointsThanTheSameNumberOnEveryEdge) {
    constexpr double max_error = 2e-3;
    for (const RefinementCase& c : refinement_cases()) {
        SCOPED_TRACE(c.name);
        const Surface surface = build_surface(c.mesh.view());
        const auto sites = points::scattered(surface, 6, 2);
        const auto exact = exact_distances(surface, sites);
        constexpr int first = 4;
        const Propagation refined =
            propagate(surface, sites,
                      {.engine = Engine::Steiner, .max_error = max_error, .steiner_points = first});
        for (int m = first;; m = 2 * m + 1) {
            ASSERT_LE(m, 1000);
            const Propagation uniform =
                propagate(surface, sites, {.engine = Engine::Steiner, .steiner_points = m});
            EXPECT_TRUE(std::isinf(uniform.certified_error));
            if (worst_error(uniform.vertex_distance, exact) > max_error) continue;
            EXPECT_GT(m, first);
            EXPECT_LT(refined.num_nodes, uniform.num_nodes);
            break;
        }
    }
}

TEST(SteinerRefinement, WhereTheErrorIsMetAtOnceTheUniformPointsStay) {
    const Surface surface = build_surface(shapes::torus(24, 12).view());
    const auto sites = points::scattered(surface, 9, 4);
    const Propagation uniform = propagate(surface, sites, {.engine = Engine::Steiner});
    const Propagation refined =
        propagate(surface, sites, {.engine = Engine::Steiner, .max_error = 0.9});
    EXPECT_TRUE(same_bytes(uniform.vertex_distance, refined.vertex_distance));
    EXPECT_TRUE(same_bytes(uniform.mixed_faces, refined.mixed_faces));
    EXPECT_TRUE(same_bytes(uniform.relays, refined.relays));
}

TEST(SteinerRefinement, SameBytesForAnyLambdaAndThreadCount) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(3), 0.03, 3).view());
    const auto sites = points::scattered(surface, 30, 9);
    const auto run = [&](double lambda, int threads) {
        return propagate(surface, sites,
                         {.engine = Engine::Steiner,
                          .max_error = 2e-3,
                          .lambda = lambda,
                          .num_threads = threads});
    };
    const Propagation one = run(1, 1);
    EXPECT_GT(one.num_nodes, surface.num_vertices() + 8 * std::size_t{surface.num_edges()});
    for (const double lambda : {0.01, 1.0, 100.0}) {
        for (const int threads : {1, 2, 3, 8}) {
            const Propagation other = run(lambda, threads);
            EXPECT_TRUE(same_bytes(one.vertex_distance, other.vertex_distance));
            EXPECT_TRUE(same_bytes(one.vertex_site, other.vertex_site));
            EXPECT_TRUE(same_bytes(one.mixed_faces, other.mixed_faces));
            EXPECT_TRUE(same_bytes(one.relay_ranges, other.relay_ranges));
            EXPECT_TRUE(same_bytes(one.relays, other.relays));
            EXPECT_EQ(one.certified_error, other.certified_error);
        }
    }
}

TEST(SteinerRefinement, RefusesWhatItCannotMeetAndSaysWhatItReached) {
    const Surface surface = build_surface(shapes::sphere(2).view());
    const auto sites = points::scattered(surface, 3, 7);
    const std::string out_of_reach =
        refusal(surface, sites, {.engine = Engine::Steiner, .max_error = 1e-9});
    EXPECT_NE(out_of_reach.find("is off by"), std::string::npos) << out_of_reach;
    EXPECT_NE(out_of_reach.find("would not suffice"), std::string::npos) << out_of_reach;
    EXPECT_NE(out_of_reach.find("use the window engine"), std::string::npos) << out_of_reach;
    PropagationOptions finest{.engine = Engine::Steiner, .steiner_points = 1000};
    const double least = worst_error(propagate(surface, sites, finest).vertex_distance,
                                     exact_distances(surface, sites));
    finest.max_error = least / 2;
    const std::string no_room = refusal(surface, sites, finest);
    EXPECT_NE(no_room.find("have 1000 points"), std::string::npos) << no_room;
    EXPECT_THROW((void)propagate(surface, sites, {.engine = Engine::Steiner, .max_error = 0}),
                 InvalidOption);
}

TEST(SteinerRefinement, ReportsRisingProgressAndStopsWhenAsked) {
    const Surface surface = build_surface(shapes::sphere(3).view());
    const auto sites = points::scattered(surface, 3, 7);
    double last = 0;
    PropagationOptions options{.engine = Engine::Steiner, .max_error = 2e-3};
    options.progress = [&](double x) {
        EXPECT_GE(x, last);
        EXPECT_LE(x, 1);
        last = x;
        return true;
    };
    (void)propagate(surface, sites, options);
    EXPECT_EQ(last, 1);
    options.progress = [](double x) { return x < 0.3; };
    EXPECT_THROW((void)propagate(surface, sites, options), Cancelled);
}
