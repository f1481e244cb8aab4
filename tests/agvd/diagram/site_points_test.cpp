// Sites of several points, and points with starts: truth is the diagram of the points for groups,
// and formulas on a plane, an unrolled prism and an unrolled cone for starts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <string>

#include "agvd/core/error.h"
#include "agvd/diagram/diagram.h"
#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "support/checks.h"
#include "support/dice.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// In the order of the points, so that ties between sites are those between points.
std::vector<Index> in_order(Index num_points, Index num_sites) {
    std::vector<Index> site;
    for (Index i = 0; i < num_points; ++i) site.push_back(i * num_sites / num_points);
    return site;
}

std::vector<Index> dealt_out(Index num_points, Index num_sites) {
    std::vector<Index> site;
    for (Index i = 0; i < num_points; ++i) site.push_back((5 * i + 3) % num_sites);
    return site;
}

std::vector<double> random_starts(std::size_t count, double most, std::uint64_t seed) {
    Dice dice(seed);
    std::vector<double> starts;
    for (std::size_t i = 0; i < count; ++i) starts.push_back(dice.number(0, most));
    return starts;
}

using Sides = std::set<std::pair<Index, Index>>;

// Pairs of sites with a common edge, each with the lower one first.
Sides pairs_of(const Diagram& diagram, const std::vector<Index>& site) {
    Sides pairs;
    for (const VoronoiEdge& e : diagram.edges) {
        if (!e.right.is_valid()) continue;
        const Index a = site[e.left.value()], b = site[e.right.value()];
        if (a != b) pairs.emplace(std::min(a, b), std::max(a, b));
    }
    return pairs;
}

// Groups against the diagram of their points.
// \return the largest difference of areas, as a share of the whole.
double expect_unions(const Surface& surface, const std::vector<Index>& site,
                     PropagationOptions options) {
    const auto num_points = static_cast<Index>(site.size());
    const Index num_sites = *std::max_element(site.begin(), site.end()) + 1;
    const auto sites = points::scattered(surface, num_points, 3);
    options.relay_faces =
        options.engine == Engine::Window ? all_faces(surface) : std::vector<Index>();
    const Propagation of_points = propagate(surface, sites, options);
    options.points.site = site;
    const Propagation of_groups = propagate(surface, sites, options);
    EXPECT_EQ(of_groups.vertex_distance, of_points.vertex_distance);
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        if (!of_points.vertex_site[v].is_valid()) continue;
        EXPECT_EQ(of_groups.vertex_site[v].value(), site[of_points.vertex_site[v].value()]) << v;
    }
    for (const SurfacePoint& p : uniform_points(surface, 500, 1)) {
        const PointLabel expected = label_at(surface, of_points, p);
        if (!expected.site.is_valid()) continue;
        const PointLabel found = label_at(surface, of_groups, p);
        EXPECT_EQ(found.site.value(), site[expected.site.value()]);
        if (expected.distance && found.distance) {
            EXPECT_EQ(*found.distance, *expected.distance);
        }
    }
    const Diagram points = build_diagram(surface, sites, of_points);
    const Diagram groups = build_diagram(surface, sites, of_groups);
    EXPECT_EQ(groups.num_sites, num_sites);
    checks::expect_valid_complex(surface, groups, static_cast<int>(num_points));
    std::vector<Index> itself(num_sites);
    for (Index s = 0; s < num_sites; ++s) itself[s] = s;
    if (num_points >= 60) {
        EXPECT_EQ(pairs_of(groups, itself), pairs_of(points, site));
    }
    std::vector<double> area(num_sites, 0);
    for (Index i = 0; i < sites.size(); ++i) area[site[i]] += points.cell_area[i];
    double largest = 0;
    for (Index s = 0; s < num_sites; ++s) {
        largest = std::max(largest, std::abs(groups.cell_area[s] - area[s]));
    }
    return largest / surface_area(surface);
}

// Distances in a plane, on an unrolled prism or cone.
using Metric = std::function<double(const SurfacePoint&, const SurfacePoint&)>;

// Weighted sites against a search over all of them.
void expect_weighted(const Surface& surface, const Metric& metric, double most,
                     std::uint64_t seed) {
    const auto sites = points::scattered(surface, 25, seed);
    const std::vector<double> starts = random_starts(sites.size(), most, seed);
    const auto nearest_of = [&](const SurfacePoint& p) {
        std::pair<double, Index> best(infinity, no_index);
        for (Index s = 0; s < sites.size(); ++s) {
            best = std::min(best, {starts[s] + metric(sites[s], p), s});
        }
        return best;
    };
    const Propagation propagation =
        propagate(surface, sites,
                  {.points = {.start = starts}, .max_error = 0, .relay_faces = all_faces(surface)});
    for (const SurfacePoint& p : uniform_points(surface, 2000, seed)) {
        const auto [distance, site] = nearest_of(p);
        const PointLabel found = label_at(surface, propagation, p);
        EXPECT_NEAR(found.distance.value(), distance, 1e-11);
        EXPECT_NEAR(starts[found.site.value()] + metric(sites[found.site.value()], p), distance,
                    1e-11);
    }
    const Diagram diagram = build_diagram(surface, sites, propagation);
    checks::expect_valid_complex(surface, diagram);
    std::size_t num_dominated = 0;
    for (Index s = 0; s < sites.size(); ++s) {
        const bool is_dominated = nearest_of(sites[s]).second != s;
        num_dominated += is_dominated ? 1 : 0;
        EXPECT_EQ(diagram.cell_area[s] == 0, is_dominated) << s;
    }
    EXPECT_GT(num_dominated, 0u);
    EXPECT_LT(num_dominated, sites.size() - 5);
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const auto [left, right, tail, head] = diagram.edges[e];
        if (!right.is_valid()) continue;
        for (Index i = diagram.edge_points[e]; i < diagram.edge_points[e + 1]; ++i) {
            const auto from = [&](SiteId s) {
                return starts[s.value()] + metric(sites[s.value()], diagram.points[i]);
            };
            EXPECT_NEAR(from(left), from(right), 1e-9) << e << ' ' << i;
        }
    }
}

double in_space(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    return (position(surface.mesh.view(), a) - position(surface.mesh.view(), b)).norm();
}

// A cone over a regular polygon of n sides with apex 0: the total angle is n times that of a face.
TriangleMesh cone(Index n, double height) {
    TriangleMesh mesh{{{0, 0, height}}, {}};
    for (Index i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n;
        mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
        mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
    }
    return mesh;
}

}  // namespace

TEST(SitesOfPoints, OwnTheCellsOfTheirPoints) {
    for (const char* family : random_meshes::families()) {
        SCOPED_TRACE(family);
        const Surface surface = build_surface(random_meshes::make(family, 1).view());
        (void)expect_unions(surface, in_order(12, 4), {.max_error = 0});
        (void)expect_unions(surface, in_order(12, 4), {.engine = Engine::Steiner});
    }
    // Inside a face a bisector of groups has corners, which are drawn as other arcs are: by chords.
    const Surface sphere = build_surface(shapes::jitter(shapes::sphere(4), 0.01, 3).view());
    EXPECT_LE(expect_unions(sphere, dealt_out(60, 7), {.max_error = 0}), 1e-3);
    EXPECT_LE(expect_unions(sphere, dealt_out(60, 2), {.engine = Engine::Steiner}), 1e-3);
    EXPECT_LE(expect_unions(sphere, dealt_out(20, 1), {.max_error = 0}), 1e-12);
}

TEST(SitesOfPoints, AreTheSameForAnyNumberOfThreads) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(3), 0.05, 3).view());
    const auto sites = points::scattered(surface, 40, 2);
    checks::expect_same_for_threads(
        surface, sites, {.points = {.site = dealt_out(40, 6), .start = random_starts(40, 0.3, 1)}});
}

TEST(SitesWithStarts, HaveHyperbolasInThePlane) {
    const Surface surface = build_surface(shapes::grid(12).view());
    const Metric metric = [&](const SurfacePoint& a, const SurfacePoint& b) {
        return in_space(surface, a, b);
    };
    for (std::uint64_t seed = 0; seed < 4; ++seed) expect_weighted(surface, metric, 0.7, seed);
}

TEST(SitesWithStarts, AreThoseOfTheUnrolledPrism) {
    const Index n = 16;
    const Surface surface = build_surface(shapes::tube(n, 8).view());
    const double side = 2 * std::sin(std::numbers::pi / n);
    const double round = n * side;
    const auto unrolled = [&](const SurfacePoint& p) {
        const Vec3 at = position(surface.mesh.view(), p);
        Vec3 middle(0, 0, 0);
        for (const Index v : surface.mesh.triangles[p.face.value()]) {
            middle += surface.mesh.positions[v] / 3;
        }
        const double turn = std::atan2(middle.y(), middle.x()) / (2 * std::numbers::pi);
        const double column = std::floor((turn < 0 ? turn + 1 : turn) * n);
        const double angle = 2 * std::numbers::pi * column / n;
        const Vec3 corner(std::cos(angle), std::sin(angle), at.z());
        return Vec2(column * side + (at - corner).norm(), at.z());
    };
    const Metric metric = [&](const SurfacePoint& a, const SurfacePoint& b) {
        const Vec2 d = unrolled(b) - unrolled(a);
        double least = infinity;
        for (const double around : {-round, 0.0, round}) {
            least = std::min(least, Vec2(d.x() + around, d.y()).norm());
        }
        return least;
    };
    for (std::uint64_t seed = 0; seed < 4; ++seed) expect_weighted(surface, metric, 1.5, seed);
}

TEST(SitesWithStarts, AreThoseOfTheUnrolledCone) {
    const Index n = 7;
    const TriangleMesh whole = cone(n, 0.8);
    const Surface surface = build_surface(shapes::subdivide(shapes::subdivide(whole)).view());
    const double length = std::sqrt(1 + 0.64);
    const double angle = 2 * std::asin(std::sin(std::numbers::pi / n) / length);
    const auto polar = [&](const SurfacePoint& p) {
        const Index sector = p.face.value() / 16;  // The face that it is a part of.
        const Vec3 from_apex = position(surface.mesh.view(), p) - whole.positions[0];
        const Vec3 along = whole.positions[whole.triangles[sector][1]] - whole.positions[0];
        return Vec2(from_apex.norm(), sector * angle + std::atan2(along.cross(from_apex).norm(),
                                                                  along.dot(from_apex)));
    };
    const Metric metric = [&](const SurfacePoint& a, const SurfacePoint& b) {
        const Vec2 p = polar(a), q = polar(b);
        double between = std::abs(p.y() - q.y());
        between = std::min(between, n * angle - between);
        if (between >= std::numbers::pi) return p.x() + q.x();
        return std::sqrt(
            std::max(0.0, p.x() * p.x() + q.x() * q.x() - 2 * p.x() * q.x() * std::cos(between)));
    };
    for (std::uint64_t seed = 0; seed < 4; ++seed) expect_weighted(surface, metric, 0.7, seed);
}

TEST(SitesWithStarts, AreNearTheExactOnesWithSteinerPoints) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(3), 0.05, 3).view());
    const auto sites = points::scattered(surface, 30, 5);
    const SitePoints weighted{.start = random_starts(30, 0.4, 2)};
    const Propagation exact = propagate(surface, sites, {.points = weighted, .max_error = 0});
    for (const std::optional<double> error : {std::optional<double>(), std::optional(1e-3)}) {
        const Propagation found = propagate(
            surface, sites, {.points = weighted, .engine = Engine::Steiner, .max_error = error});
        for (Index v = 0; v < surface.num_vertices(); ++v) {
            EXPECT_GE(found.vertex_distance[v], exact.vertex_distance[v] - 1e-12);
            EXPECT_LE(found.vertex_distance[v],
                      exact.vertex_distance[v] * (1 + error.value_or(0.02)));
        }
        const Diagram a = build_diagram(surface, sites, exact);
        const Diagram b = build_diagram(surface, sites, found);
        checks::expect_valid_complex(surface, b);
        for (Index s = 0; s < 30; ++s) EXPECT_NEAR(a.cell_area[s], b.cell_area[s], 0.1) << s;
    }
}

// Far from 0: the queue counts from the start of each site.
TEST(SitesWithStarts, KeepTheirCellsIfAllStartLater) {
    const Surface surface = build_surface(shapes::torus(24, 12).view());
    const auto sites = points::scattered(surface, 20, 5);
    std::vector<double> starts = random_starts(20, 0.5, 2);
    const Propagation soon =
        propagate(surface, sites, {.points = {.start = starts}, .max_error = 0});
    for (double& start : starts) start += 1000;
    for (const Engine engine : {Engine::Window, Engine::Steiner}) {
        std::optional<double> error;
        if (engine == Engine::Window) error = 0;
        const Propagation late = propagate(
            surface, sites, {.points = {.start = starts}, .engine = engine, .max_error = error});
        for (Index v = 0; v < surface.num_vertices(); ++v) {
            EXPECT_NEAR(late.vertex_distance[v], soon.vertex_distance[v] + 1000,
                        engine == Engine::Window ? 1e-9 : 0.03);
        }
    }
}

TEST(SitesWithStarts, OfPointsAtOnePlaceTheLeastStartCounts) {
    const Surface surface = build_surface(shapes::grid(4).view());
    const SurfacePoint here = points::scattered(surface, 1, 1)[0];
    const std::vector<SurfacePoint> sites{here, here, here};
    for (const Engine engine : {Engine::Window, Engine::Steiner}) {
        const Diagram diagram = build_diagram(
            surface, sites,
            propagate(surface, sites, {.points = {.start = {0.2, 0.1, 0.1}}, .engine = engine}));
        EXPECT_EQ(diagram.cell_area[0], 0);
        EXPECT_NEAR(diagram.cell_area[1], 1, 1e-12);
        EXPECT_EQ(diagram.cell_area[2], 0);
    }
}

TEST(SitePoints, AreChecked) {
    const Surface surface = build_surface(shapes::grid(2).view());
    const auto sites = points::scattered(surface, 3, 1);
    const auto propagated = [&](const SitePoints& given) {
        return propagate(surface, sites, {.points = given});
    };
    EXPECT_THROW((void)propagated({.site = {0, 1}}), InvalidOption);
    EXPECT_THROW((void)propagated({.start = {0, 1}}), InvalidOption);
    EXPECT_THROW((void)propagated({.site = {0, 2, 2}}), InvalidSites);
    EXPECT_THROW((void)propagated({.site = {0, 1, no_index}}), InvalidSites);
    EXPECT_THROW((void)propagated({.start = {0, -1, 0}}), InvalidSites);
    EXPECT_THROW((void)propagated({.start = {0, infinity, 0}}), InvalidSites);
    EXPECT_THROW((void)propagated({.start = {0, std::nan(""), 0}}), InvalidSites);
    EXPECT_NO_THROW((void)propagated({.site = {1, 0, 1}, .start = {0, 1, 0}}));
}
