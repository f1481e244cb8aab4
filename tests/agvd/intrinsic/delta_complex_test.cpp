// On an intrinsic triangulation, a Delta-complex, everything is what it is on the input.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numeric>

#include "agvd/diagram/diagram.h"
#include "agvd/diagram/face_relays.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/paths/geodesic_path.h"
#include "agvd/propagation/propagate.h"
#include "remesh/clean/clean_input.h"
#include "remesh/dual/build_dual.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/arbiter.h"
#include "support/checks.h"
#include "support/delta_shapes.h"
#include "support/files.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/random_surfaces.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

constexpr double metric_rounding = 1e-9;

// A mesh, and a base of it with sites on both.
struct Case {
    Surface input;
    IntrinsicTriangulation base;
    std::vector<SurfacePoint> on_input, on_base;

    Case(const TriangleMesh& mesh, std::uint64_t seed, Index num_sites)
        : input(build_surface(mesh.view())), base(input, options(seed)) {
        Dice dice(seed);
        while (on_input.size() < num_sites) {
            on_input.push_back(points::anywhere(dice, dice.count(0, input.num_faces() - 1)));
        }
        on_base = base.to_intrinsic(on_input);
    }

    // Every other one is split.
    [[nodiscard]] IntrinsicOptions options(std::uint64_t seed) const {
        if (seed % 2 == 0) return {};
        return {.max_length = 0.4 * shapes::longest_edge(input)};
    }
    [[nodiscard]] const Surface& surface() const { return base.surface(); }
};

TriangleMesh mesh_of(std::string_view family, std::uint64_t seed) {
    const auto of_deltas = delta_shapes::families();
    if (std::find(of_deltas.begin(), of_deltas.end(), family) != of_deltas.end()) {
        return delta_shapes::make(family, seed);
    }
    return random_meshes::make(family, seed);
}

std::vector<const char*> all_families() {
    std::vector<const char*> all(delta_shapes::families().begin(), delta_shapes::families().end());
    const auto others = random_meshes::families();
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

// What a mesh cannot have.
struct Oddities {
    Index loops = 0, self_glued = 0, twice_shared = 0;
};

Oddities oddities_of(const Surface& surface) {
    Oddities found;
    for (Index h = 0; h < surface.twin.size(); ++h) {
        if (surface.tail(h) == surface.head(h)) ++found.loops;
        const Index twin = surface.twin[h];
        if (twin == no_index) continue;
        const Index face = Surface::face(h), across = Surface::face(twin);
        if (face == across) ++found.self_glued;
        const Index other = surface.twin[Surface::next(h)];
        if (face != across && other != no_index && Surface::face(other) == across) {
            ++found.twice_shared;
        }
    }
    return found;
}

void expect_same_distances(const Case& c, std::span<const SurfacePoint> targets) {
    const double size = shapes::longest_edge(c.input);
    const PropagationOptions exactly{.max_error = 0, .num_threads = 1};
    const Propagation here = propagate(c.input, c.on_input, exactly);
    const Propagation there = propagate(c.surface(), c.on_base, exactly);
    for (Index v = 0; v < c.input.num_vertices(); ++v) {
        const double expected = here.vertex_distance[v];
        if (expected == std::numeric_limits<double>::infinity()) {
            EXPECT_EQ(there.vertex_distance[v], expected) << v;
        } else {
            EXPECT_NEAR(there.vertex_distance[v], expected, metric_rounding * (expected + size))
                << v;
        }
    }
    if (targets.empty()) return;
    const arbiter::Distances truth = arbiter::nearest_sites(c.input, c.on_input, targets);
    for (Index i = 0; i < targets.size(); ++i) {
        const Index v = *vertex_of(c.input, targets[i]);
        const auto expected = static_cast<double>(truth.distance[i]);
        if (expected == std::numeric_limits<double>::infinity()) continue;
        EXPECT_NEAR(there.vertex_distance[v], expected, metric_rounding * (expected + size)) << v;
    }
}

std::vector<SurfacePoint> vertices_of(const Surface& surface) {
    std::vector<SurfacePoint> vertices;
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        if (surface.outgoing[v] != no_index) vertices.push_back(point_at(surface, v));
    }
    return vertices;
}

}  // namespace

class DeltaComplexOf : public testing::TestWithParam<const char*> {
protected:
    static constexpr std::uint64_t num_seeds = 12;

    template <typename Check>
    void for_each_case(Index num_sites, const Check& check) {
        for (std::uint64_t seed = 0; seed < num_seeds; ++seed) {
            SCOPED_TRACE("seed " + std::to_string(seed));
            const Case c(mesh_of(GetParam(), seed), seed, num_sites);
            ASSERT_NO_FATAL_FAILURE(check(c, seed));
        }
    }
};

INSTANTIATE_TEST_SUITE_P(Families, DeltaComplexOf, testing::ValuesIn(all_families()),
                         [](const auto& family) { return std::string(family.param); });

TEST_P(DeltaComplexOf, ExactDistancesAreThoseOfTheInput) {
    for (const Index num_sites : {1, 5}) {
        for_each_case(num_sites, [](const Case& c, std::uint64_t) {
            const bool is_small = c.input.num_faces() < 200;
            expect_same_distances(c, is_small ? vertices_of(c.input) : std::vector<SurfacePoint>());
        });
    }
}

TEST_P(DeltaComplexOf, NoEngineFallsShortOfExactDistances) {
    for_each_case(6, [](const Case& c, std::uint64_t) {
        const Propagation exact =
            propagate(c.surface(), c.on_base, {.max_error = 0, .num_threads = 1});
        const double slack = metric_rounding * shapes::longest_edge(c.input);
        const auto expect_above = [&](const PropagationOptions& options, double most) {
            const Propagation other = propagate(c.surface(), c.on_base, options);
            for (Index v = 0; v < c.surface().num_vertices(); ++v) {
                if (!exact.vertex_site[v].is_valid()) continue;
                const double least = exact.vertex_distance[v] * (1 - metric_rounding) - slack;
                EXPECT_GE(other.vertex_distance[v], least) << v;
                EXPECT_LE(other.vertex_distance[v], exact.vertex_distance[v] * most + slack) << v;
            }
        };
        const double any = 1e6;
        expect_above({.max_error = 1e-2, .num_threads = 1}, 1.01);
        expect_above({.engine = Engine::Steiner, .num_threads = 1}, any);
    });
}

// A face may have a vertex at several corners: the relays of the face serve each of them.
TEST_P(DeltaComplexOf, RelaysReachEveryCornerNoFartherThanItsVertex) {
    for_each_case(4, [](const Case& c, std::uint64_t) {
        const Surface& s = c.surface();
        const double slack = metric_rounding * shapes::longest_edge(c.input);
        for (const auto engine : {Engine::Window, Engine::Steiner}) {
            SCOPED_TRACE(engine_name(engine));
            PropagationOptions options{.engine = engine, .num_threads = 1};
            if (engine == Engine::Window) options.max_error = 0;
            const Propagation p = propagate(s, c.on_base, options);
            for (const Index face : p.mixed_faces) {
                for (Index k = 0; k < 3; ++k) {
                    SurfacePoint corner{FaceId(face), {0, 0, 0}};
                    corner.barycentric[k] = 1;
                    const PointLabel label = point_label(s, p, corner);
                    ASSERT_TRUE(label.distance.has_value());
                    const double at_vertex = p.vertex_distance[s.tail(3 * face + k)];
                    EXPECT_LE(*label.distance, at_vertex * (1 + 1e-6) + slack) << face << " " << k;
                }
            }
        }
    });
}

TEST_P(DeltaComplexOf, TheSteinerEngineMeetsItsBound) {
    for_each_case(3, [](const Case& c, std::uint64_t) {
        constexpr double bound = 0.02;
        const Propagation exact =
            propagate(c.surface(), c.on_base, {.max_error = 0, .num_threads = 1});
        Propagation within;
        try {
            within = propagate(c.surface(), c.on_base,
                               {.engine = Engine::Steiner, .max_error = bound, .num_threads = 1});
        } catch (const ConstraintUnmet&) {
            return;  // Sites that all but lie on a vertex.
        }
        for (Index v = 0; v < c.surface().num_vertices(); ++v) {
            if (!exact.vertex_site[v].is_valid()) continue;
            EXPECT_LE(within.vertex_distance[v],
                      exact.vertex_distance[v] * (1 + bound + 1e-11) + 1e-14);
        }
    });
}

TEST_P(DeltaComplexOf, DiagramsOfAllEnginesAreValidComplexes) {
    for (const Index num_sites : {2, 12}) {
        for_each_case(num_sites, [](const Case& c, std::uint64_t seed) {
            for (const auto engine : {Engine::Window, Engine::Steiner}) {
                SCOPED_TRACE(engine_name(engine));
                const Propagation p =
                    propagate(c.surface(), c.on_base, {.engine = engine, .num_threads = 1});
                const Diagram d = build_diagram(c.surface(), c.on_base, p,
                                                {.num_threads = static_cast<int>(seed % 2 + 1)});
                checks::expect_valid_complex(c.surface(), d);
                const double area = std::accumulate(d.cell_area.begin(), d.cell_area.end(), 0.0);
                EXPECT_GT(area, 0);
            }
        });
    }
}

// On faces that are small against cells; against samples of the input's distances.
TEST_P(DeltaComplexOf, CellsHaveTheAreasOfThoseOfTheInput) {
    for (std::uint64_t seed = 0; seed < num_seeds; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Surface input = build_surface(mesh_of(GetParam(), seed).view());
        const IntrinsicTriangulation base(input, {.max_length = 0.1 * shapes::longest_edge(input)});
        const std::vector<SurfacePoint> sites = uniform_points(input, 8, seed);
        const std::vector<SurfacePoint> on_base = base.to_intrinsic(sites);
        const PropagationOptions exactly{.max_error = 0, .num_threads = 1};
        const Propagation here = propagate(input, sites, exactly);
        const Propagation there = propagate(base.surface(), on_base, exactly);
        const Diagram diagram = build_diagram(base.surface(), on_base, there);
        double area = 0;
        for (Index f = 0; f < input.num_faces(); ++f) area += face_area(input, f);

        constexpr Index num_samples = 4000;
        std::vector<double> expected(sites.size(), 0);
        for (const SurfacePoint& point : uniform_points(input, num_samples, 99)) {
            const PointLabel truth = point_label(input, here, point);
            if (!truth.site.is_valid()) continue;
            expected[truth.site.value()] += area / num_samples;
            const PointLabel label = point_label(base.surface(), there, base.to_intrinsic(point));
            if (truth.distance && label.distance) {
                EXPECT_NEAR(*label.distance, *truth.distance,
                            metric_rounding * shapes::longest_edge(input));
            }
        }
        // Four standard deviations of a share of a half.
        const double slack = 4 * 0.5 / std::sqrt(num_samples) * area;
        for (Index s = 0; s < sites.size(); ++s) {
            EXPECT_NEAR(diagram.cell_area[s], expected[s], slack) << s;
        }
    }
}

TEST_P(DeltaComplexOf, DualEdgesAreLocallyShortestAndNoShorterThanDistances) {
    for_each_case(1, [](const Case& c, std::uint64_t seed) {
        const std::vector<SurfacePoint> on_input = uniform_points(c.input, 14, seed);
        const std::vector<SurfacePoint> on_base = c.base.to_intrinsic(on_input);
        const Propagation p = propagate(c.surface(), on_base, {.num_threads = 1});
        const Diagram d = build_diagram(c.surface(), on_base, p, {.num_threads = 1});
        const double slack = metric_rounding * shapes::longest_edge(c.input);
        for (const Triangle& t : remesh::build_dual(d)) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Index a = t[k], b = t[(k + 1) % 3];
                const GeodesicPath path = path_between(c.surface(), on_base[a], on_base[b]);
                EXPECT_TRUE(path.is_locally_shortest);
                const auto truth = arbiter::nearest_sites(c.input, std::span(&on_input[a], 1),
                                                          std::span(&on_input[b], 1));
                EXPECT_GE(path.length,
                          static_cast<double>(truth.distance[0]) * (1 - metric_rounding) - slack);
            }
        }
    });
}

// On edges along which a face is glued to itself: such a site lies twice in its face.
TEST(DeltaComplex, SitesOnSeamsAreSeenFromBothSides) {
    Index num_seams = 0;
    for (const char* family : {"doubled_triangle", "spike", "delta_tetrahedron", "plane_needles"}) {
        for (std::uint64_t seed = 0; seed < 24; ++seed) {
            SCOPED_TRACE(std::string(family) + " " + std::to_string(seed));
            const Surface input = build_surface(delta_shapes::make(family, seed).view());
            const IntrinsicTriangulation base(input);
            const Surface& s = base.surface();
            std::vector<SurfacePoint> sites;
            for (Index h = 0; h < s.twin.size(); ++h) {
                if (s.twin[h] == no_index || Surface::face(s.twin[h]) != Surface::face(h)) continue;
                SurfacePoint& site = sites.emplace_back();
                site = {FaceId(Surface::face(h)), {0, 0, 0}};
                site.barycentric[h % 3] = 0.3;
                site.barycentric[Surface::next(h) % 3] = 0.7;
            }
            num_seams += static_cast<Index>(sites.size()) / 2;
            if (sites.empty()) continue;
            const std::vector<SurfacePoint> on_input = base.to_input(sites);
            const PropagationOptions exactly{.max_error = 0, .num_threads = 1};
            const Propagation here = propagate(input, on_input, exactly);
            const Propagation there = propagate(s, sites, exactly);
            std::vector<double> area(sites.size(), 0);
            constexpr Index num_samples = 2000;
            const double slack = metric_rounding * shapes::longest_edge(input);
            double whole = 0;
            for (Index f = 0; f < s.num_faces(); ++f) whole += face_area(s, f);
            for (const SurfacePoint& point : uniform_points(input, num_samples, seed)) {
                const PointLabel truth = point_label(input, here, point);
                area[truth.site.value()] += whole / num_samples;
                const PointLabel label = point_label(s, there, base.to_intrinsic(point));
                if (!truth.distance || !label.distance) continue;
                EXPECT_NEAR(*label.distance, *truth.distance, slack);
            }
            const Diagram d = build_diagram(s, sites, there);
            checks::expect_valid_complex(s, d);
            for (Index i = 0; i < sites.size(); ++i) {
                EXPECT_NEAR(d.cell_area[i], area[i], 0.06 * whole) << "cell " << i;
            }
            // Label changes on edges lie where both sites are as near as they say.
            for (Index i = 0; i < d.points.size(); ++i) {
                if (d.passages[i].side == Passage::none || d.passages[i].leaves) continue;
                const PointLabel label = point_label(s, there, d.points[i]);
                if (!label.distance) continue;
                EXPECT_NEAR(*label.distance, d.point_distance[i], slack) << i;
            }
            const Propagation other =
                propagate(s, sites, {.engine = Engine::Steiner, .num_threads = 1});
            for (Index v = 0; v < s.num_vertices(); ++v) {
                EXPECT_GE(other.vertex_distance[v], there.vertex_distance[v] - slack);
            }
            for (const SurfacePoint& point : uniform_points(s, 200, seed)) {
                const PointLabel label = point_label(s, other, point);
                const PointLabel truth = point_label(s, there, point);
                if (!label.distance || !truth.distance) continue;
                EXPECT_GE(*label.distance, *truth.distance - slack);
                // A spacing of the points off at most.
                EXPECT_LE(*label.distance, *truth.distance + 0.15 * shapes::longest_edge(s));
            }
            checks::expect_valid_complex(s, build_diagram(s, sites, other));
        }
    }
    EXPECT_GT(num_seams, 10u);
}

// The face of a seam has one other side: what lies across that sees a site on the seam straight
// from either of the two sides.
TEST(DeltaComplex, ASiteOnASeamIsSeenFromAcrossByTheShorterWay) {
    Index num_seen = 0;
    for (const char* family : {"doubled_triangle", "spike", "delta_tetrahedron", "plane_needles"}) {
        for (std::uint64_t seed = 0; seed < 24; ++seed) {
            SCOPED_TRACE(std::string(family) + " " + std::to_string(seed));
            const Surface input = build_surface(delta_shapes::make(family, seed).view());
            const IntrinsicTriangulation base(input);
            const Surface& s = base.surface();
            for (Index h = 0; h < s.twin.size(); ++h) {
                const Index face = Surface::face(h), twin = s.twin[h];
                if (twin == no_index || Surface::face(twin) != face) continue;
                const Index third = 9 * face + 3 - h - twin;
                const Index across = s.twin[third];
                if (across == no_index || Surface::face(across) == face) continue;
                SurfacePoint site{FaceId(face), {0, 0, 0}};
                site.barycentric[h % 3] = 0.3;
                site.barycentric[Surface::next(h) % 3] = 0.7;
                const double length = s.length_of(third);
                const Vec2 apex(length - s.apex[across].x(), -s.apex[across].y());
                double straight = std::numeric_limits<double>::infinity();
                for (const SurfacePoint& view : {site, across_edge(s, site, h)}) {
                    const Vec2 p = position_in_frame(s, view, third);
                    const double x = p.x() + (apex.x() - p.x()) * p.y() / (p.y() - apex.y());
                    if (x < 0.05 * length || x > 0.95 * length) continue;
                    straight = std::min(straight, (p - apex).norm());
                }
                if (straight == std::numeric_limits<double>::infinity()) continue;
                ++num_seen;
                const Index v = s.tail(Surface::previous(across));
                const std::vector<SurfacePoint> sites{site};
                const auto distance = [&](const PropagationOptions& options) {
                    return propagate(s, sites, options).vertex_distance[v];
                };
                EXPECT_LE(distance({.max_error = 0, .num_threads = 1}),
                          straight * (1 + metric_rounding));
                EXPECT_LE(
                    distance({.engine = Engine::Steiner, .steiner_points = 200, .num_threads = 1}),
                    straight * 1.001);
            }
        }
    }
    EXPECT_GT(num_seen, 10u);
}

TEST(DeltaComplex, TheFamiliesHoldWhatAMeshCannot) {
    Oddities all;
    for (const char* family : delta_shapes::families()) {
        for (std::uint64_t seed = 0; seed < 12; ++seed) {
            const Case c(delta_shapes::make(family, seed), seed, 1);
            const Oddities found = oddities_of(c.surface());
            all.loops += found.loops;
            all.self_glued += found.self_glued;
            all.twice_shared += found.twice_shared;
        }
    }
    EXPECT_GT(all.loops, 20u);
    EXPECT_GT(all.self_glued, 20u);
    EXPECT_GT(all.twice_shared, 20u);
}

// Parts of machines, of needles: the window engine on the base against the same on the input.
class DirtyMesh : public testing::TestWithParam<const char*> {};

TEST_P(DirtyMesh, ExactDistancesAreThoseOfTheInput) {
    const auto path = files::find_mesh(GetParam());
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << path << " is absent; set AGVD_MESHES to the folder that has it";
    }
    const TriangleMesh mesh = remesh::clean_input(remesh::read_mesh(path).mesh.view()).mesh;
    const Surface input = build_surface(mesh.view());
    const IntrinsicTriangulation base(input);
    EXPECT_TRUE(base.counts().is_delaunay);
    const std::vector<SurfacePoint> on_input = uniform_points(input, 300, 5);
    const PropagationOptions exactly{.max_error = 0};
    const Propagation here = propagate(input, on_input, exactly);
    const std::vector<SurfacePoint> on_base = base.to_intrinsic(on_input);
    const Propagation there = propagate(base.surface(), on_base, exactly);
    const double size = shapes::longest_edge(input);
    double worst = 0;
    for (Index v = 0; v < input.num_vertices(); ++v) {
        if (!here.vertex_site[v].is_valid()) continue;
        worst = std::max(worst, std::abs(there.vertex_distance[v] - here.vertex_distance[v]));
    }
    EXPECT_LE(worst, metric_rounding * size);
    checks::expect_valid_complex(base.surface(), build_diagram(base.surface(), on_base, there));
}

INSTANTIATE_TEST_SUITE_P(Meshes, DirtyMesh,
                         testing::Values("data/slivers.off", "data/part.off", "dirty/79741.stl",
                                         "dirty/58011.stl", "dirty/65004.stl", "dirty/72214.stl"),
                         [](const auto& name) {
                             return std::filesystem::path(name.param).stem().string();
                         });
