// Straightened paths and the edges of the dual against exact distances.
#include <gtest/gtest.h>

#include <numeric>

#include "agvd/diagram/build_diagram.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "paper/oracle.h"
#include "remesh/dual/build_dual.h"
#include "remesh/dual/delaunay.h"
#include "remesh/dual/straighten.h"
#include "support/geodesics.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

TEST(StraightenAgainstExact, IsNeverShorter) {
    for (const TriangleMesh& mesh : {shapes::jitter(shapes::sphere(3), 0.03, 1),
                                     shapes::jitter(shapes::torus(24, 12), 0.05, 2),
                                     shapes::jitter(shapes::grid(12), 0.03, 3), shapes::cube()}) {
        const Surface surface = build_surface(mesh.view());
        const auto ends = points::scattered(surface, 12, 1);
        Index num_exact = 0, num_paths = 0;
        for (const SurfacePoint& a : ends) {
            const std::vector<double> exact = exact_distances(surface, a, ends);
            for (std::size_t i = 0; i < ends.size(); ++i) {
                if (exact[i] == 0) continue;
                double shortest = std::numeric_limits<double>::infinity();
                for (std::uint64_t seed = 1; seed <= 5; ++seed) {
                    const remesh::GeodesicPath path = remesh::straightest_path(
                        surface, geodesics::random_strip(surface, a, ends[i], seed));
                    EXPECT_GE(path.length, exact[i] * (1 - 1e-9));
                    EXPECT_LT(geodesics::largest_bend(surface, path.points), 1e-6);
                    shortest = std::min(shortest, path.length);
                }
                ++num_paths;
                if (shortest <= exact[i] * (1 + 1e-9)) ++num_exact;
            }
        }
        EXPECT_GT(3 * num_exact, num_paths);
    }
}

TEST(StraightenAgainstExact, DualEdgesAreShortestPathsUnlessTheSurfaceBends) {
    const TriangleMesh mesh = shapes::jitter(shapes::torus(48, 24), 0.01, 2);
    const Surface surface = build_surface(mesh.view());
    const std::vector<SurfacePoint> sites = uniform_points(surface, 150, 1);
    const Diagram diagram = build_diagram(surface, sites, propagate(surface, sites));
    std::vector<Index> site(sites.size());
    std::iota(site.begin(), site.end(), 0U);
    std::vector<agvd::Vec3> positions;
    for (const SurfacePoint& point : sites) positions.push_back(position(mesh.view(), point));
    const remesh::DelaunayResult result = remesh::make_delaunay(
        surface, sites, positions, site, diagram, remesh::build_dual(surface, diagram));
    Index num_exact = 0, num_sides = 0;
    for (std::size_t t = 0; t < result.triangles.size(); ++t) {
        const auto [a, b, c] = result.triangles[t];
        const std::array targets{sites[b], sites[c]};
        const std::vector<double> exact = exact_distances(surface, sites[a], targets);
        const std::array lengths{result.side_lengths[t][0], result.side_lengths[t][2]};
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_GE(lengths[k], exact[k] * (1 - 1e-9));
            EXPECT_LE(lengths[k], exact[k] * 1.05);
            ++num_sides;
            if (lengths[k] <= exact[k] * (1 + 1e-9)) ++num_exact;
        }
    }
    EXPECT_GT(num_exact, 0.9 * num_sides);
}
