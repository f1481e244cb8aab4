#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "agvd/core/error.h"
#include "agvd/mesh/surface_points.h"
#include "paper/oracle.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

SurfacePoint face_point(const Surface& surface, Index face, const Vec3& at) {
    const auto& [a, b, c] = surface.mesh.triangles[face];
    const auto& p = surface.mesh.positions;
    const Vec3 normal = (p[b] - p[a]).cross(p[c] - p[a]);
    const double area = normal.squaredNorm();
    const double u = (p[c] - p[b]).cross(at - p[b]).dot(normal) / area;
    const double v = (p[a] - p[c]).cross(at - p[c]).dot(normal) / area;
    return {FaceId(face), {u, v, 1 - u - v}};
}

}  // namespace

TEST(Oracle, PlaneHasEuclideanDistances) {
    const Surface s = build_surface(shapes::grid(6).view());
    const auto places = points::scattered(s, 60, 1);
    for (Index i = 0; i < 9; ++i) {
        const auto distances = exact_distances(s, places[i], places);
        for (Index j = 0; j < places.size(); ++j) {
            const Vec3 gap =
                position(s.mesh.view(), places[i]) - position(s.mesh.view(), places[j]);
            EXPECT_NEAR(distances[j], gap.norm(), 1e-13) << "from " << i << " to " << j;
        }
    }
}

TEST(Oracle, CylinderUnrolls) {
    const Index n = 16;
    const Surface s = build_surface(shapes::tube(n, 6).view());
    const double side = 2 * std::sin(std::numbers::pi / n);
    const auto column = [](Index v) { return v / 7; };
    for (const Index from : {Index{3}, Index{20}, Index{0}}) {
        std::vector<SurfacePoint> targets;
        for (Index v = 0; v < s.num_vertices(); ++v) targets.push_back(point_at(s, v));
        const auto distances = exact_distances(s, point_at(s, from), targets);
        for (Index v = 0; v < s.num_vertices(); ++v) {
            const Index turn =
                column(v) > column(from) ? column(v) - column(from) : column(from) - column(v);
            const double along = s.mesh.positions[v].z() - s.mesh.positions[from].z();
            EXPECT_NEAR(distances[v], std::hypot(side * std::min(turn, n - turn), along), 1e-13);
        }
    }
}

// Opposite corners of the unit cube: sqrt(5); the spider and fly of two facing sides: the shortest
// of the straight unfolding over one side, |z| gap 1, and those over two sides.
TEST(Oracle, CubeFollowsItsNets) {
    const Surface s = build_surface(shapes::cube().view());
    const std::vector<SurfacePoint> corner{point_at(s, 7)};
    EXPECT_NEAR(exact_distances(s, point_at(s, 0), corner)[0], std::sqrt(5.0), 1e-14);

    const SurfacePoint floor = face_point(s, 0, {0.3, 0.8, 0});  // Face 0: x <= y at z = 0.
    const std::vector<SurfacePoint> roof{
        face_point(s, 3, {0.2, 0.6, 1})};  // Face 3: x <= y, z = 1.
    const auto over_one_side = [](double a, double b, double shift) {
        return std::hypot(1 + a + b, shift);
    };
    const auto over_two_sides = [](double a, double b, double c, double d) {
        return std::hypot(1 + a + b, 1 + c + d);
    };
    double shortest = 10;
    const double x = 0.3, y = 0.8, u = 0.2, v = 0.6;
    shortest = std::min(shortest, over_one_side(x, u, y - v));
    shortest = std::min(shortest, over_one_side(1 - x, 1 - u, y - v));
    shortest = std::min(shortest, over_one_side(y, v, x - u));
    shortest = std::min(shortest, over_one_side(1 - y, 1 - v, x - u));
    for (const auto& [a, b, c, d] :
         {std::array{x, y, u, v}, std::array{1 - x, y, 1 - u, v}, std::array{x, 1 - y, u, 1 - v},
          std::array{1 - x, 1 - y, 1 - u, 1 - v}}) {
        shortest = std::min(shortest, over_two_sides(a, d, b, c));
        shortest = std::min(shortest, over_two_sides(b, c, a, d));
    }
    EXPECT_NEAR(exact_distances(s, floor, roof)[0], shortest, 1e-14);
}

// A straight line over the net of the tetrahedron stays straight for ever: distances are those of
// the lattice of its unfolding, a vertex to the middle of the opposite face is two heights' thirds.
TEST(Oracle, TetrahedronUnfoldsToALattice) {
    const Surface s = build_surface(shapes::tetrahedron().view());
    const double edge = std::sqrt(8.0);
    const std::vector<SurfacePoint> targets{
        point_at(s, 1), {FaceId(3), {1.0 / 3, 1.0 / 3, 1.0 / 3}}, {FaceId(3), {0.5, 0.5, 0}}};
    const auto distances = exact_distances(s, point_at(s, 0), targets);
    EXPECT_NEAR(distances[0], edge, 1e-14);
    EXPECT_NEAR(distances[1], edge * 2 / std::sqrt(3.0), 1e-14);
    EXPECT_NEAR(distances[2], edge * std::sqrt(3.0) / 2, 1e-14);
}

// Between opposite vertices lies a strip of faces: over one face, an edge's middle and two more.
TEST(Oracle, IcosahedronAntipodesAreOneStripApart) {
    const Surface s = build_surface(shapes::icosahedron().view());
    const double edge = s.length[0];
    const std::vector<SurfacePoint> antipode{point_at(s, 3)};
    EXPECT_NEAR(exact_distances(s, point_at(s, 0), antipode)[0], edge * std::sqrt(7.0), 1e-13);
}

// A wrong window almost never errs by the same amount in both directions.
TEST(Oracle, DistancesAreSymmetric) {
    for (const TriangleMesh& mesh :
         {shapes::jitter(shapes::sphere(2), 0.05, 3), shapes::jitter(shapes::torus(18, 9), 0.03, 4),
          shapes::jitter(shapes::tube(12, 6), 0.05, 5), shapes::cube(),
          shapes::jitter(shapes::grid(8), 0.03, 6)}) {
        const Surface s = build_surface(mesh.view());
        const auto places = points::scattered(s, 24, 11);
        std::vector<std::vector<double>> distances;
        for (const auto& point : places) distances.push_back(exact_distances(s, point, places));
        for (Index i = 0; i < places.size(); ++i) {
            EXPECT_NEAR(distances[i][i], 0, 1e-14);
            for (Index j = 0; j < i; ++j) {
                EXPECT_NEAR(distances[i][j], distances[j][i], 1e-12) << i << " and " << j;
            }
        }
    }
}

TEST(Oracle, AllSitesAtOnceGiveTheNearest) {
    const Surface s = build_surface(shapes::jitter(shapes::torus(24, 12), 0.03, 4).view());
    const auto sites = points::scattered(s, 12, 2);
    const auto targets = points::scattered(s, 200, 3);
    const NearestSites nearest = exact_nearest_sites(s, sites, targets);
    const auto each =
        exact_distances(s, sites, std::vector<std::vector<SurfacePoint>>(sites.size(), targets), 2);
    for (Index i = 0; i < targets.size(); ++i) {
        double lowest = 10;
        for (const auto& distances : each) lowest = std::min(lowest, distances[i]);
        EXPECT_NEAR(nearest.distance[i], lowest, 1e-12);
        EXPECT_NEAR(each[nearest.site[i].value()][i], lowest, 1e-12);
    }
}

TEST(Oracle, OneSearchIsExactFromOneSiteAndNeverTooShortFromMany) {
    const Surface s = build_surface(shapes::jitter(shapes::torus(24, 12), 0.03, 4).view());
    const auto sites = points::scattered(s, 12, 2);
    const auto targets = points::scattered(s, 200, 3);
    const auto from_first = distances_by_one_search(s, {sites.data(), 1}, targets);
    const auto from_all = distances_by_one_search(s, sites, targets);
    const auto exact_from_first = exact_distances(s, sites[0], targets);
    Index num_exact = 0;
    const NearestSites nearest = exact_nearest_sites(s, sites, targets);
    for (Index i = 0; i < targets.size(); ++i) {
        EXPECT_NEAR(from_first[i], exact_from_first[i], 1e-12);
        EXPECT_GE(from_all[i], nearest.distance[i] - 1e-12);
        num_exact += from_all[i] <= nearest.distance[i] + 1e-12;
    }
    EXPECT_GT(num_exact, 180u);  // Windows are lost here and there only.
}

// Near targets are answered on a part of the surface; asking for a far one too takes all of it.
TEST(Oracle, PartsOfTheSurfaceGiveTheSameDistances) {
    const Surface s = build_surface(shapes::jitter(shapes::sphere(4), 0.01, 3).view());
    const auto places = points::scattered(s, 400, 5);
    for (Index i = 0; i < 6; ++i) {
        const Vec3 centre = position(s.mesh.view(), places[i]);
        std::vector<SurfacePoint> near;
        for (const auto& point : places) {
            if ((position(s.mesh.view(), point) - centre).norm() < 0.4) near.push_back(point);
        }
        ASSERT_GT(near.size(), 3u);
        const auto in_part = exact_distances(s, places[i], near);
        auto with_far = near;
        with_far.insert(with_far.end(), places.begin(), places.end());
        const auto in_whole = exact_distances(s, places[i], with_far);
        for (Index j = 0; j < near.size(); ++j) EXPECT_NEAR(in_part[j], in_whole[j], 1e-13);
    }
}

// Across a slit the way around is much longer than the distance in space.
TEST(Oracle, PathsLeadAroundASlit) {
    TriangleMesh mesh = shapes::grid(20);
    const auto is_in_slit = [&](const Triangle& t) {
        return std::all_of(t.begin(), t.end(), [&](Index v) {
            const Vec3& p = mesh.positions[v];
            return p.x() > 0.49 && p.x() < 0.56 && p.y() > 0.04;
        });
    };
    std::erase_if(mesh.triangles, is_in_slit);
    const Surface s = build_surface(mesh.view());
    const std::vector<SurfacePoint> target{point_at(s, 12 * 21 + 16)};  // (0.6, 0.8)
    const double around = std::hypot(0.1, 0.75) + 0.05 + std::hypot(0.05, 0.75);
    EXPECT_NEAR(exact_distances(s, point_at(s, 8 * 21 + 16), target)[0], around, 1e-13);
}

TEST(Oracle, AnotherComponentIsOutOfReach) {
    const Surface s = build_surface(shapes::join(shapes::grid(2), shapes::sphere(1)).view());
    const std::vector<SurfacePoint> site{point_at(s, 0)};
    const std::vector<SurfacePoint> targets{point_at(s, 8), point_at(s, 12)};
    const NearestSites nearest = exact_nearest_sites(s, site, targets);
    EXPECT_NEAR(nearest.distance[0], std::sqrt(2.0), 1e-15);
    EXPECT_TRUE(std::isinf(nearest.distance[1]));
    EXPECT_FALSE(nearest.site[1].is_valid());
    EXPECT_TRUE(std::isinf(exact_distances(s, site[0], targets)[1]));
}

TEST(Oracle, EachSiteNeedsItsListOfTargets) {
    const Surface s = build_surface(shapes::grid(2).view());
    const std::vector<SurfacePoint> sites{point_at(s, 0), point_at(s, 1)};
    const std::vector<std::vector<SurfacePoint>> targets(1);
    EXPECT_THROW((void)exact_distances(s, sites, targets), InvalidInput);
}
