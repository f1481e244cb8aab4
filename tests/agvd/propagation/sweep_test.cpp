// The order in which nodes are settled changes no distance and no path.
#include "agvd/propagation/steiner/sweep.h"

#include <gtest/gtest.h>

#include <string>

#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/propagation/propagate.h"
#include "support/checks.h"
#include "support/dice.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// Between any points of any face the height changes by less than their distance.
void expect_gentle(const Surface& surface, std::uint64_t seed) {
    const Sweep sweep(surface);
    Dice dice(seed);
    const double rounding = 1e-12 * sweep.range();
    for (Index f = 0; f < surface.num_faces(); ++f) {
        for (int i = 0; i < 4; ++i) {
            const SurfacePoint a = points::anywhere(dice, f);
            const SurfacePoint b = points::anywhere(dice, f);
            const double rise = std::abs(sweep.height(surface, a) - sweep.height(surface, b));
            EXPECT_LE(rise, 0.9001 * face_distance(surface, a, b) + rounding) << "face " << f;
            EXPECT_GE(sweep.height(surface, a), -rounding);
            EXPECT_LE(sweep.height(surface, a), sweep.range() + rounding);
        }
    }
}

// The same lengths, with positions that say nothing of them: a line along an axis, or a point.
Surface with_positions(const Surface& surface, const Vec3& axis) {
    TriangleMesh mesh = surface.mesh;
    std::vector<double> lengths;
    for (Index h = 0; h < 3 * surface.num_faces(); ++h) lengths.push_back(surface.length_of(h));
    for (Vec3& p : mesh.positions) p = 0.5 * axis.cwiseProduct(p);
    return build_surface(mesh.view(), lengths);
}

}  // namespace

TEST(Sweep, RisesLessThanAnyPathIsLong) {
    expect_gentle(build_surface(shapes::grid(6).view()), 1);
    for (const char* family : random_meshes::families()) {
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            SCOPED_TRACE(std::string(family) + " " + std::to_string(seed));
            const Surface surface = build_surface(random_meshes::make(family, seed).view());
            expect_gentle(surface, seed);
            expect_gentle(IntrinsicTriangulation(surface).surface(), seed);
        }
    }
}

TEST(Sweep, GoesAlongTheLongestAxis) {
    TriangleMesh mesh = shapes::grid(4);
    for (Vec3& p : mesh.positions) p.y() *= 3;
    const Surface surface = build_surface(mesh.view());
    const Sweep sweep(surface);
    const double low = mesh.positions[0].y();
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        EXPECT_NEAR(sweep.height(v), 0.9 * (mesh.positions[v].y() - low), 1e-12);
    }
}

// On grids many paths are equally long.
TEST(Sweep, ChangesNoPropagation) {
    for (const TriangleMesh& mesh :
         {shapes::grid(12), shapes::jitter(shapes::sphere(3), 0.05, 3), shapes::torus(20, 10)}) {
        const Surface surface = build_surface(mesh.view());
        const Surface level = with_positions(surface, {0, 0, 0});
        for (const Index t : {1u, 12u, 100u}) {
            const auto sites = points::scattered(surface, t, t);
            const PropagationOptions options{.engine = Engine::Steiner, .lambda = 0.2};
            const Propagation by_distance = propagate(level, sites, options);
            for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, -1, 0)}) {
                const Surface tilted = with_positions(surface, axis);
                EXPECT_GT(Sweep(tilted).range(), 0);
                checks::expect_same(by_distance, propagate(tilted, sites, options));
            }
        }
    }
}
