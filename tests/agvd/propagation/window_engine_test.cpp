// The window engine against formulas, against itself in another order, and its bookkeeping.
#include "agvd/propagation/engines.h"
#include "agvd/propagation/propagate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "agvd/core/error.h"
#include "agvd/mesh/surface_points.h"
#include "support/checks.h"
#include "support/dirty_shapes.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

Propagation exact(const Surface& surface, std::span<const SurfacePoint> sites) {
    return propagate(surface, sites, {.engine = Engine::Window, .max_error = 0.0});
}

// The unit square without its upper right quarter; vertex (i, j) is 21 i + j.
TriangleMesh l_shape() {
    TriangleMesh mesh = shapes::grid(20);
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        const Vec3 middle =
            (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3;
        return middle.x() > 0.5 && middle.y() > 0.5;
    });
    return mesh;
}

}  // namespace

TEST(WindowEngine, PlaneHasEuclideanDistances) {
    const TriangleMesh mesh = shapes::grid(20);
    const Surface plane = build_surface(mesh.view());
    const auto sites = points::scattered(plane, 12, 3);
    const Propagation p = exact(plane, sites);
    for (Index v = 0; v < plane.num_vertices(); ++v) {
        double least = 10;
        for (const SurfacePoint& site : sites) {
            least = std::min(least, (mesh.positions[v] - position(mesh.view(), site)).norm());
        }
        EXPECT_NEAR(p.vertex_distance[v], least, 1e-12) << "vertex " << v;
    }
}

// Behind a reflex corner paths bend: around the inner corner of an L.
TEST(WindowEngine, PathsTurnAtReflexCorners) {
    const Surface s = build_surface(l_shape().view());
    const auto at = [](int i, int j) { return static_cast<Index>(i * 21 + j); };
    const std::vector<SurfacePoint> site{point_at(s, at(4, 20))};
    const Vec3 from = s.mesh.positions[at(4, 20)];
    const Vec3 corner = s.mesh.positions[at(10, 10)];
    const Propagation p = exact(s, site);
    int turned = 0;
    for (Index v = 0; v < s.num_vertices(); ++v) {
        if (s.outgoing[v] == no_index) continue;
        const Vec3 to = s.mesh.positions[v];
        // Left of the line from the site through the corner the corner is in the way.
        const bool is_behind =
            (corner - from).cross(to - from).z() * (from.x() < from.y() ? 1 : -1) > 1e-12 &&
            (to - corner).dot(corner - from) > -1e-12;
        const double straight = (to - from).norm();
        const double bent = (corner - from).norm() + (to - corner).norm();
        if (is_behind) ++turned;
        EXPECT_NEAR(p.vertex_distance[v], is_behind ? bent : straight, 1e-12) << to.transpose();
    }
    EXPECT_GT(turned, 10);
}

// Where rounding hides on which side of the vertex the site lies.
TEST(WindowEngine, ASiteBesideAVertexSeesAllAround) {
    for (const TriangleMesh& mesh : {shapes::jitter(shapes::grid(6), 0.02, 5), shapes::sphere(2)}) {
        const Surface s = build_surface(mesh.view());
        for (const double beside : {1e-11, 1e-13, 1e-15, 1e-18}) {
            for (Index f = 0; f < s.num_faces(); f += 7) {
                const std::vector<SurfacePoint> vertex{{FaceId(f), {1, 0, 0}}};
                const Propagation at = exact(s, vertex);
                for (const SurfacePoint& site :
                     {SurfacePoint{FaceId(f), {1 - 2 * beside, beside, beside}},
                      SurfacePoint{FaceId(f), {1 - beside, beside, 0}},
                      SurfacePoint{FaceId(f), {1 - beside, beside, beside * beside}}}) {
                    const Propagation p = exact(s, std::vector{site});
                    for (Index v = 0; v < s.num_vertices(); ++v) {
                        EXPECT_NEAR(p.vertex_distance[v], at.vertex_distance[v], 1e-10) << v;
                    }
                }
            }
        }
    }
}

// Where it hides on which side of the vertex a beam passes: one along the boundary must not miss
// the next vertex of it.
TEST(WindowEngine, ASiteOnAnEdgeNearAVertexReachesAllThatTheVertexReaches) {
    const char* const family = "reflex_boundary";
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Surface s = build_surface(random_meshes::make(family, seed).view());
        for (Index h = 0; h < 3 * s.num_faces(); h += 5) {
            const Index vertex = s.tail(h);
            const Propagation at = exact(s, std::vector{point_at(s, vertex)});
            for (const double beside : {3e-7, 2e-6, 9e-6}) {
                SurfacePoint site{FaceId(Surface::face(h)), {0, 0, 0}};
                site.barycentric[h % 3] = 1 - beside;
                site.barycentric[(h + 1) % 3] = beside;
                const Propagation p = exact(s, std::vector{site});
                for (Index v = 0; v < s.num_vertices(); ++v) {
                    if (at.vertex_distance[v] == p.vertex_distance[v]) continue;  // Infinity, too.
                    EXPECT_NEAR(p.vertex_distance[v], at.vertex_distance[v],
                                beside * s.length_of(h) + 1e-9 * at.vertex_distance[v])
                        << "from beside " << vertex << " to " << v;
                }
            }
        }
    }
}

// On a strip whose edges are far shorter than the error, arrivals at its reflex vertices differ by
// less than their errors and must not send each other on for ever.
TEST(WindowEngine, TurnsCloserThanTheErrorEnd) {
    TriangleMesh mesh;  // A strip that bends at every vertex of its lower side, after a long face.
    constexpr Index num_steps = 60;
    for (Index i = 0; i <= num_steps; ++i) {
        const double angle = 1e-4 * i;
        for (const double radius : {1.0, 1 + 1e-4}) {
            mesh.positions.emplace_back(radius * std::sin(angle), radius * std::cos(angle), 0);
        }
        if (i == 0) continue;
        const Index k = 2 * i;
        mesh.triangles.push_back({k - 2, k, k - 1});
        mesh.triangles.push_back({k - 1, k, k + 1});
    }
    mesh.positions.emplace_back(-1, 1 + 5e-5, 0);
    mesh.triangles.push_back({0, 1, 2 * num_steps + 2});
    const Surface s = build_surface(mesh.view());
    const std::vector<SurfacePoint> site{point_at(s, 2 * num_steps + 2)};
    const Propagation truth = exact(s, site);
    for (const double max_error : {1e-3, 1e-2, 0.1}) {
        const Propagation p = propagate(s, site, {.max_error = max_error});
        for (Index v = 0; v < s.num_vertices(); ++v) {
            EXPECT_LE(p.vertex_distance[v], truth.vertex_distance[v] * (1 + max_error));
            EXPECT_GE(p.vertex_distance[v], truth.vertex_distance[v] * (1 - 1e-12));
        }
    }
}

// Larger errors take longer from few sites: the engine takes .005 for all of them, and says so.
TEST(WindowEngine, AnErrorThatIsNotQuickerIsNotTaken) {
    const Surface s = build_surface(shapes::jitter(shapes::torus(60, 40), 0.02, 1).view());
    const std::vector<SurfacePoint> site{point_at(s, 0)};
    const Propagation at_most = propagate(s, site, {.max_error = 0.005});
    EXPECT_GT(at_most.certified_error, 1e-3);
    EXPECT_NE(propagate(s, site, {.max_error = 4e-3}).vertex_distance, at_most.vertex_distance);
    for (const double max_error : {0.006, 0.1, 0.9}) {
        const Propagation found = propagate(s, site, {.max_error = max_error});
        EXPECT_EQ(found.vertex_distance, at_most.vertex_distance);
        EXPECT_EQ(found.certified_error, at_most.certified_error);
    }
}

// Bounds along thousands of short edges must not fall short of the way by their rounding.
TEST(WindowEngine, LongWaysOverThinRowsArriveEverywhere) {
    TriangleMesh mesh;
    constexpr Index rows = 700, columns = 30;
    for (Index i = 0; i <= columns; ++i) {
        for (Index j = 0; j <= rows; ++j) mesh.positions.emplace_back(i / 30.0, j * 1.3e-6, 0);
    }
    for (Index i = 0; i < columns; ++i) {
        for (Index j = 0; j < rows; ++j) {
            const Index a = i * (rows + 1) + j, b = a + rows + 1;
            mesh.triangles.insert(mesh.triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
        }
    }
    const Surface s = build_surface(mesh.view());
    for (const Index v : {rows / 2, rows}) {
        const Propagation p = propagate(s, std::vector{point_at(s, v)}, {.max_error = 1e-4});
        for (Index w = 0; w < s.num_vertices(); ++w) {
            const double truth = (mesh.positions[w] - mesh.positions[v]).norm();
            ASSERT_NEAR(p.vertex_distance[w], truth, 1e-4 * truth) << w;
        }
    }
}

// Several sites in each face.
TEST(WindowEngine, MoreSitesThanFaces) {
    const Surface s = build_surface(shapes::cube().view());
    const auto sites = points::scattered(s, 60, 8);
    ASSERT_GT(sites.size(), s.num_faces());
    const Propagation p = exact(s, sites);
    EXPECT_EQ(p.mixed_faces.size(), s.num_faces());
    std::vector<bool> has_relay(sites.size(), false);
    for (const Relay& r : p.relays) has_relay[r.site.value()] = true;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const auto& b = sites[i].barycentric;  // Several sites may share a vertex: one owns it.
        if (std::count(b.begin(), b.end(), 0.0) < 2) {
            EXPECT_TRUE(has_relay[i]) << "site " << i;
        }
    }
}

TEST(WindowEngine, ComponentsWithoutASiteAreOutOfReach) {
    const Surface s = build_surface(shapes::join(shapes::grid(3), shapes::sphere(1)).view());
    const std::vector<SurfacePoint> site{point_at(s, 0)};
    const Propagation p = exact(s, site);
    for (Index v = 0; v < s.num_vertices(); ++v) {
        EXPECT_EQ(std::isfinite(p.vertex_distance[v]), v < 16) << "vertex " << v;
        EXPECT_EQ(p.vertex_site[v].is_valid(), v < 16) << "vertex " << v;
    }
    EXPECT_TRUE(p.mixed_faces.empty());
}

// Behind a common saddle two sites tie over a whole region: the lower one owns it.
TEST(WindowEngine, TheLowerSiteOwnsATieBehindACorner) {
    const Surface s = build_surface(l_shape().view());
    const Vec3 corner = s.mesh.positions[10 * 21 + 10];
    // Both at the same distance from the corner, in directions that see the same region by it only.
    std::vector<SurfacePoint> sites{point_at(s, 6 * 21 + 13), point_at(s, 7 * 21 + 14)};
    for (const auto& site : sites) {
        ASSERT_NEAR((position(s.mesh.view(), site) - corner).norm(), 0.25, 1e-12);
    }
    for (int turn = 0; turn < 2; ++turn) {
        const Propagation p = exact(s, sites);
        for (Index v = 0; v < s.num_vertices(); ++v) {
            if (s.outgoing[v] == no_index || s.mesh.positions[v].x() < 0.8 ||
                s.mesh.positions[v].y() > 0.3) {
                continue;
            }
            const double at_corner = (s.mesh.positions[v] - corner).norm() + 0.25;
            if (std::abs(p.vertex_distance[v] - at_corner) > 1e-12) continue;
            EXPECT_EQ(p.vertex_site[v].value(), 0u) << s.mesh.positions[v].transpose();
        }
        std::swap(sites[0], sites[1]);
    }
}

TEST(WindowEngine, SameBytesForAnyThreadCount) {
    const Surface s = build_surface(shapes::jitter(shapes::torus(60, 30), 0.01, 3).view());
    const auto sites = points::scattered(s, 150, 2);
    for (const double max_error : {0.0, 1e-3}) {
        PropagationOptions options{.max_error = max_error, .num_threads = 1};
        const Propagation one = propagate(s, sites, options);
        for (const int threads : {2, 3, 8}) {
            options.num_threads = threads;
            checks::expect_same(one, propagate(s, sites, options));
        }
    }
}

TEST(WindowEngine, ALayoutAtHandChangesNothing) {
    const Surface s = build_surface(shapes::jitter(shapes::torus(40, 20), 0.02, 7).view());
    const SurfaceLayout layout(s);
    for (const Engine engine : {Engine::Window, Engine::Steiner}) {
        for (const Index count : {1, 9}) {
            const auto sites = points::scattered(s, count, 4);
            checks::expect_same(propagate(s, sites, {.engine = engine}),
                                propagate(s, layout, sites, {.engine = engine}));
            checks::expect_same(propagate(s, sites, {.engine = engine}),
                                propagate(s, SurfaceLayout(s), sites, {.engine = engine}));
        }
    }
}

// A cap of nothing sends every site the slow way.
TEST(WindowEngine, PastTheWorkCapDistancesAreTheSame) {
    const Surface s = build_surface(shapes::jitter(shapes::torus(40, 20), 0.02, 7).view());
    const auto sites = points::scattered(s, 9, 4);
    const Propagation quick = exact(s, sites);
    const Propagation slow =
        propagate_windows(s, SurfaceLayout(s), sites, {.max_error = 0.0, .num_threads = 1}, 0);
    EXPECT_EQ(quick.vertex_site, slow.vertex_site);
    EXPECT_EQ(quick.mixed_faces, slow.mixed_faces);
    for (Index v = 0; v < s.num_vertices(); ++v) {
        EXPECT_NEAR(quick.vertex_distance[v], slow.vertex_distance[v], 1e-13);
    }
}

TEST(WindowEngine, ErrorsStayBelowWhatIsCertified) {
    const Surface s = build_surface(shapes::jitter(shapes::sphere(5), 0.003, 3).view());
    const auto sites = points::scattered(s, 5, 6);
    const Propagation best = exact(s, sites);
    EXPECT_EQ(best.certified_error, 0);
    std::size_t last = best.num_nodes;
    for (const double max_error : {1e-4, 1e-3, 1e-2}) {
        const Propagation p = propagate(s, sites, {.max_error = max_error});
        EXPECT_GT(p.certified_error, 0);
        EXPECT_LE(p.certified_error, max_error);
        EXPECT_LT(p.num_nodes, last) << "fewer windows with a larger error";
        last = p.num_nodes;
        for (Index v = 0; v < s.num_vertices(); ++v) {
            EXPECT_GE(p.vertex_distance[v], best.vertex_distance[v] * (1 - 1e-12));
            EXPECT_LE(p.vertex_distance[v],
                      best.vertex_distance[v] * (1 + p.certified_error + 1e-12));
        }
    }
}

TEST(WindowEngine, KeepsRelaysOnlyWhereLabelsMeet) {
    const Surface s = build_surface(shapes::sphere(5).view());
    const Propagation alone = exact(s, points::scattered(s, 1, 1));
    EXPECT_TRUE(alone.mixed_faces.empty());
    EXPECT_TRUE(alone.relays.empty());
    const Propagation few = exact(s, points::scattered(s, 4, 1));
    EXPECT_LT(few.mixed_faces.size(), s.num_faces() / 4);
}

// 100 bytes of a face are the layout; one site gives some 20 windows of 64 bytes to each.
TEST(WindowEngine, FewSitesNeedLittleMoreMemoryThanTheLayout) {
    const Surface s = build_surface(shapes::jitter(shapes::sphere(6), 0.003, 3).view());
    const auto bytes_per_face = [&](Index count, double max_error) {
        const Propagation p = propagate(s, points::scattered(s, count, 1),
                                        {.max_error = max_error, .num_threads = 1});
        return static_cast<double>(p.peak_bytes) / s.num_faces();
    };
    EXPECT_LT(bytes_per_face(1, 0), 300);
    EXPECT_LT(bytes_per_face(1, 1e-3), 250);
    EXPECT_LT(bytes_per_face(10, 0), 600);
}

// Contract of Propagation::mixed_faces, and all is reached.
void expect_sound(const Surface& s, const Propagation& p) {
    std::vector<bool> is_mixed(s.num_faces(), false);
    for (const Index f : p.mixed_faces) is_mixed[f] = true;
    for (Index f = 0; f < s.num_faces(); ++f) {
        for (const Index v : s.mesh.triangles[f]) {
            EXPECT_TRUE(p.vertex_site[v].is_valid());
            EXPECT_TRUE(std::isfinite(p.vertex_distance[v]));
            EXPECT_TRUE(is_mixed[f] || p.vertex_site[v] == p.vertex_site[s.mesh.triangles[f][0]]);
        }
    }
}

TEST(WindowEngine, AllIsReachedWhereSpikesLeaveNoDigits) {
    Index num_off = 0, num_uncertified = 0, num_tried = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const std::optional<Surface> spiked = shapes::spiked_surface(seed);
        if (!spiked) continue;
        const Surface& s = *spiked;
        ++num_tried;
        for (const Index num_sites : {1u, 3u, 40u}) {
            const auto sites = points::scattered(s, num_sites, seed);
            for (const double max_error : {0.0, 1e-3}) {
                const PropagationOptions options{.max_error = max_error};
                const Propagation p = propagate(s, sites, options);
                expect_sound(s, p);
                num_off += static_cast<Index>(p.vertices_off_windows.size());
                num_uncertified += std::isinf(p.certified_error) ? 1 : 0;
            }
        }
    }
    EXPECT_GE(num_tried, 20u);
    EXPECT_GT(num_off, 0u) << "no case of it";
    EXPECT_GT(num_uncertified, 0u) << "no case of it";
}

TEST(WindowEngine, WindowsReachAllOfSoundMeshes) {
    Index num_tried = 0;
    for (const char* family : random_meshes::families()) {
        for (std::uint64_t seed = 0; seed < 5; ++seed) {
            const Surface s = build_surface(random_meshes::make(family, seed).view());
            const auto sites = points::scattered(s, 5, seed);
            for (const double max_error : {0.0, 1e-4, 1e-2}) {
                const Propagation p = propagate(s, sites, {.max_error = max_error});
                EXPECT_TRUE(p.vertices_off_windows.empty()) << family << " " << seed;
                EXPECT_LE(p.certified_error, max_error);
                ++num_tried;
            }
        }
    }
    EXPECT_GE(num_tried, 100u);
}

TEST(WindowEngine, RefusesErrorsOutOfRange) {
    const Surface s = build_surface(shapes::cube().view());
    const auto sites = points::scattered(s, 2, 1);
    for (const double bad : {-1e-9, 1.0, 7.0, std::nan("")}) {
        EXPECT_THROW((void)propagate(s, sites, {.max_error = bad}), InvalidOption) << bad;
    }
}

TEST(WindowEngine, AStoppedRunThrows) {
    const Surface s = build_surface(shapes::sphere(3).view());
    const auto sites = points::scattered(s, 40, 1);
    EXPECT_THROW((void)propagate(s, sites, {.progress = [](double f) { return f < 0.3; }}),
                 Cancelled);
}
