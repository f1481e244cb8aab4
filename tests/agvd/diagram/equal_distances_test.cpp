// The points of exact bisectors are as far from both sites, by the relays of the propagation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "agvd/diagram/diagram.h"
#include "agvd/diagram/face_relays.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "support/checks.h"
#include "support/points.h"
#include "support/random_meshes.h"

using namespace agvd;

namespace {

// |dA - dB| at a point between two cells.
double gap_at(const Surface& surface, const Propagation& propagation, const SurfacePoint& p,
              const VoronoiEdge& edge) {
    const std::optional<Index> mixed = mixed_index_of(propagation, p.face.value());
    if (!mixed) return infinity;
    double left = infinity, right = infinity;
    const Vec2 at = position_in_frame(surface, p, 3 * p.face.value());
    for (const Relay& relay : relays_of(propagation, *mixed)) {
        const PlanarRelay planar = to_planar(relay, to_face_frame(surface, relay.half_edge));
        const double distance = reach(planar, at).distance;
        if (relay.site == edge.left) left = std::min(left, distance);
        if (relay.site == edge.right) right = std::min(right, distance);
    }
    return std::abs(left - right);
}

// The largest gap at the points of the bisectors, in cell radii. Edges are short: on some of these
// meshes an image lies on the line of an edge, beyond its end.
double largest_gap(const TriangleMesh& mesh, Index num_sites) {
    const Surface input = build_surface(mesh.view());
    const double area = surface_area(input);
    const IntrinsicTriangulation base(input, {.max_length = 0.2 * std::sqrt(area)});
    const Surface& surface = base.surface();
    const auto sites = base.to_intrinsic(points::scattered(input, num_sites, 3));
    const Propagation propagation = propagate(surface, sites, {.max_error = 0});
    const Diagram diagram = build_diagram(surface, sites, propagation);
    double largest = 0;
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        if (!diagram.edges[e].right.is_valid()) continue;
        for (Index i = diagram.edge_points[e]; i < diagram.edge_points[e + 1]; ++i) {
            const double gap = gap_at(surface, propagation, diagram.points[i], diagram.edges[e]);
            largest = std::max(largest, gap);
        }
    }
    return largest / std::sqrt(area / (std::numbers::pi * num_sites));
}

}  // namespace

TEST(EqualDistances, HoldAtThePointsOfBisectorsOnRandomMeshes) {
    for (const char* family : random_meshes::families()) {
        for (std::uint64_t seed = 0; seed < 3; ++seed) {
            SCOPED_TRACE(std::string(family) + " seed " + std::to_string(seed));
            EXPECT_LE(largest_gap(random_meshes::make(family, seed), 9), 1e-10);
        }
    }
}

namespace {

// n x m squares of size 1 / n, whose diagonals are parallel or alternate.
TriangleMesh squares(Index n, Index m, bool alternate) {
    const double side = 1.0 / n;
    TriangleMesh mesh;
    for (Index i = 0; i <= n; ++i) {
        for (Index j = 0; j <= m; ++j) mesh.positions.emplace_back(j * side, i * side, 0);
    }
    for (Index i = 0; i < n; ++i) {
        for (Index j = 0; j < m; ++j) {
            const Index a = i * (m + 1) + j, b = a + 1, c = b + m + 1, d = a + m + 1;
            const bool turned = alternate && (i + j) % 2 == 1;
            mesh.triangles.push_back(turned ? Triangle{a, b, d} : Triangle{a, b, c});
            mesh.triangles.push_back(turned ? Triangle{b, c, d} : Triangle{a, c, d});
        }
    }
    return mesh;
}

// Sites at the vertices of the boundary: bisectors pass through vertices, and four cells meet in
// points of edges. Returns the number of points of bisectors.
std::size_t expect_equal_distances(const TriangleMesh& mesh) {
    const Surface surface = build_surface(mesh.view());
    std::vector<SurfacePoint> sites;
    std::vector<Vec3> places;
    const auto loops = boundary_loops(surface);
    for (const Index h : loops.at(0)) {
        sites.push_back(point_at(surface, surface.tail(h)));
        places.push_back(mesh.positions[surface.tail(h)]);
    }
    const Diagram diagram =
        build_diagram(surface, sites, propagate(surface, sites, {.max_error = 0}));
    checks::expect_valid_complex(surface, diagram);
    std::size_t num_points = 0;
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const VoronoiEdge& edge = diagram.edges[e];
        if (!edge.right.is_valid()) continue;
        for (Index i = diagram.edge_points[e]; i < diagram.edge_points[e + 1]; ++i) {
            const Vec3 p = position(mesh, diagram.points[i]);
            double least = infinity;
            for (const Vec3& place : places) least = std::min(least, (p - place).norm());
            EXPECT_NEAR((p - places[edge.left.value()]).norm(), least, 1e-9) << p.transpose();
            EXPECT_NEAR((p - places[edge.right.value()]).norm(), least, 1e-9) << p.transpose();
            ++num_points;
        }
    }
    return num_points;
}

}  // namespace

TEST(EqualDistances, HoldWhereCellsMeetAtVerticesAndOnEdges) {
    std::size_t num_points = 0;
    for (Index n = 3; n <= 12; ++n) {
        for (const Index m : {n, 2 * n, 2 * n + 1}) {
            for (const bool alternate : {false, true}) {
                SCOPED_TRACE(std::to_string(n) + " x " + std::to_string(m));
                num_points += expect_equal_distances(squares(n, m, alternate));
            }
        }
    }
    EXPECT_GT(num_points, 10000U);
}
