// The vertex engine against exact geodesics: every distance that it gives is that of a path.

#include <gtest/gtest.h>

#include <cmath>

#include "agvd/core/random.h"
#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "paper/oracle.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

constexpr double sum_rounding = 1e-9;

struct Shape {
    const char* name;
    TriangleMesh (*make)();
};

class VertexEngine : public testing::TestWithParam<Shape> {
protected:
    Surface surface = build_surface(GetParam().make().view());
};

// The plane as a hilly landscape: saddles, needles and a boundary.
TriangleMesh hills() {
    TriangleMesh mesh = shapes::jitter(shapes::grid(14), 0.02, 6);
    for (Vec3& p : mesh.positions) p.z() = 0.2 * std::sin(9 * p.x()) * std::cos(7 * p.y());
    return mesh;
}

const Shape vertex_engine_meshes[] = {
    {"jittered_sphere", [] { return shapes::jitter(shapes::sphere(2), 0.08, 1); }},
    {"torus", [] { return shapes::torus(24, 12); }},
    {"jittered_torus", [] { return shapes::jitter(shapes::torus(24, 12), 0.03, 2); }},
    {"open_grid", [] { return shapes::grid(10); }},
    {"jittered_grid", [] { return shapes::jitter(shapes::grid(12), 0.02, 3); }},
    {"open_tube", [] { return shapes::tube(20, 8); }},
    {"hills", hills},
    {"cube", [] { return shapes::subdivide(shapes::subdivide(shapes::cube())); }},
};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Oracle, VertexEngine, testing::ValuesIn(vertex_engine_meshes),
                         [](const auto& test) { return test.param.name; });

TEST_P(VertexEngine, DistancesAtVerticesAreNeverBelowTheExactOnes) {
    std::vector<SurfacePoint> targets;
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        targets.push_back(point_at(surface, v));
    }
    for (const Index t : {1u, 5u, 30u}) {
        const auto sites = points::scattered(surface, t, t);
        const Propagation p = propagate(surface, sites, {.engine = Engine::Vertex});
        const NearestSites exact = exact_nearest_sites(surface, sites, targets);
        double mean = 0;
        Index wrong = 0;
        for (Index v = 0; v < surface.num_vertices(); ++v) {
            EXPECT_GE(p.vertex_distance[v], exact.distance[v] * (1 - sum_rounding))
                << "vertex " << v;
            if (exact.distance[v] > 0) mean += p.vertex_distance[v] / exact.distance[v] - 1;
            if (p.vertex_site[v] != exact.site[v]) ++wrong;
        }
        EXPECT_LT(mean / surface.num_vertices(), 0.008) << t << " sites";
        EXPECT_LT(wrong, 1 + surface.num_vertices() / 20) << t << " sites";
    }
}

TEST_P(VertexEngine, DistancesThroughRelaysAreNeverBelowTheExactOnes) {
    const auto sites = points::scattered(surface, 12, 3);
    const Propagation p = propagate(surface, sites, {.engine = Engine::Vertex});
    std::vector<SurfacePoint> targets;
    std::vector<double> through;
    for (Index i = 0; i < p.mixed_faces.size(); ++i) {
        const Index face = p.mixed_faces[i];
        std::vector<PlanarRelay> relays;
        append_planar(surface, relays_of(p, i), {}, relays);
        const auto corners = face_corners(surface, face);
        for (std::uint64_t k = 0; k < 3; ++k) {
            const double root = std::sqrt(random_unit(i, k, 0));
            const double b1 = root * random_unit(i, k, 1);
            const double b2 = root - b1;
            targets.push_back({FaceId(face), {1 - root, b1, b2}});
            through.push_back(nearest(relays, b1 * corners[1] + b2 * corners[2]).distance);
        }
    }
    ASSERT_FALSE(targets.empty());
    const NearestSites exact = exact_nearest_sites(surface, sites, targets);
    double mean = 0;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        EXPECT_GE(through[i], exact.distance[i] * (1 - sum_rounding));
        mean += through[i] / exact.distance[i] - 1;
    }
    EXPECT_LT(mean / static_cast<double>(targets.size()), 0.04);
}
