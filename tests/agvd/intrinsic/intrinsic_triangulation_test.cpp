#include "agvd/intrinsic/intrinsic_triangulation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "agvd/core/error.h"
#include "agvd/intrinsic/operations.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"
#include "support/checks.h"
#include "support/delta_shapes.h"
#include "support/dice.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

constexpr std::uint64_t num_seeds = 12;

double diagonal(const TriangleMesh& mesh) {
    Vec3 low = mesh.positions[0], high = low;
    for (const Vec3& p : mesh.positions) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return (high - low).norm();
}

double area_of(const Surface& surface) {
    double sum = 0;
    for (Index f = 0; f < surface.num_faces(); ++f) sum += face_area(surface, f);
    return sum;
}

// Twins, edges, ends, lengths, apexes and one-rings fit together.
void expect_consistent(const Surface& s) {
    const double size = shapes::longest_edge(s);
    ASSERT_EQ(s.twin.size(), std::size_t{3} * s.num_faces());
    ASSERT_EQ(s.length.size(), s.edge_half.size());
    std::vector<Index> num_corners(s.num_vertices(), 0), num_sides(s.num_edges(), 0);
    for (Index h = 0; h < s.twin.size(); ++h) {
        ++num_corners[s.tail(h)];
        ++num_sides[s.edge[h]];
        const Index twin = s.twin[h];
        EXPECT_EQ(s.edge_half[s.edge[h]], std::min(h, twin)) << h;
        if (twin != no_index) {
            EXPECT_EQ(s.twin[twin], h);
            EXPECT_EQ(s.edge[twin], s.edge[h]);
            EXPECT_EQ(s.tail(twin), s.head(h));
            EXPECT_EQ(s.head(twin), s.tail(h));
        }
        const double rounding = 1e-12 * size;
        EXPECT_NEAR(s.apex[h].norm(), s.length_of(Surface::previous(h)), rounding) << h;
        EXPECT_NEAR((s.apex[h] - Vec2(s.length_of(h), 0)).norm(), s.length_of(Surface::next(h)),
                    rounding)
            << h;
        EXPECT_GT(s.apex[h].y(), 0) << h;
    }
    for (Index e = 0; e < s.num_edges(); ++e) {
        EXPECT_EQ(num_sides[e], s.twin[s.edge_half[e]] == no_index ? 1u : 2u) << e;
    }
    for (Index v = 0; v < s.num_vertices(); ++v) {
        Index seen = 0;
        for_each_outgoing(s, v, [&](Index h) {
            EXPECT_EQ(s.tail(h), v);
            ++seen;
        });
        EXPECT_EQ(seen, num_corners[v]) << v;
    }
}

// By the angles opposite: their cosines sum to at least 0 less rounding.
bool is_delaunay_at(const Surface& s, Index h) {
    const auto angle = [&](Index half_edge) {
        const Vec2 to_tail = -s.apex[half_edge];
        const Vec2 to_head = Vec2(s.length_of(half_edge), 0) - s.apex[half_edge];
        return std::atan2(to_tail.x() * to_head.y() - to_tail.y() * to_head.x(),
                          to_tail.dot(to_head));
    };
    return angle(h) + angle(s.twin[h]) <= std::acos(-1.0) + 1e-7;
}

bool has_flat_vertices(std::uint64_t seed) { return seed % 4 >= 2; }

template <typename Check>
void for_each_mesh(const Check& check) {
    for (const char* family : delta_shapes::families()) {
        for (std::uint64_t seed = 0; seed < num_seeds; ++seed) {
            SCOPED_TRACE(std::string(family) + " " + std::to_string(seed));
            TriangleMesh mesh = delta_shapes::make(family, seed);
            if (has_flat_vertices(seed)) shapes::add_flat_vertices(mesh, 30, seed);
            ASSERT_NO_FATAL_FAILURE(check(mesh, build_surface(mesh.view()), seed));
        }
    }
}

IntrinsicOptions options_of(const Surface& input, std::uint64_t seed) {
    IntrinsicOptions options;
    if (seed % 2 == 1) options.max_length = 0.3 * shapes::longest_edge(input);
    if (has_flat_vertices(seed)) options.min_length = 0.2 * shapes::longest_edge(input);
    return options;
}

void expect_same_place(const Surface& s, const SurfacePoint& a, const SurfacePoint& b,
                       double rounding) {
    EXPECT_LE((position(s.mesh.view(), a) - position(s.mesh.view(), b)).norm(), rounding);
}

Index num_changed(const IntrinsicTriangulation& base) {
    Index count = 0;
    for (Index f = 0; f < base.surface().num_faces(); ++f) count += base.is_changed(f) ? 1 : 0;
    return count;
}

}  // namespace

TEST(FaceOperations, RandomFlipsAndSplitsKeepEverythingConsistent) {
    Index num_flips = 0, num_self_glued = 0, num_loops = 0;
    for_each_mesh([&](const TriangleMesh&, Surface surface, std::uint64_t seed) {
        const double area = area_of(surface);
        Poller poller;
        detail::raise_degenerate_faces(surface, 1, poller);
        detail::FaceCharts charts(surface);
        Dice dice(seed);
        for (int step = 0; step < 60; ++step) {
            const Index h = dice.count(0, 3 * surface.num_faces() - 1);
            const Index twin = surface.twin[h];
            if (dice.one_in(6)) {
                (void)detail::split_edge(surface, charts, h, 0.5, detail::add_vertex(surface));
                num_self_glued +=
                    twin != no_index && Surface::face(h) == Surface::face(twin) ? 1 : 0;
            } else if (twin != no_index && Surface::face(h) != Surface::face(twin)) {
                const detail::Quad quad = detail::quad_at(surface, charts, h);
                const detail::QuadShares share = quad.shares();
                // No needles of its own making.
                if (!quad.is_convex() || share.tail < 0.02 || share.head < 0.02) continue;
                detail::flip(surface, charts, h, quad);
                ++num_flips;
                num_loops += surface.tail(h) == surface.head(h) ? 1 : 0;
            }
        }
        expect_consistent(surface);
        EXPECT_NEAR(area_of(surface), area, 1e-10 * area);
    });
    EXPECT_GT(num_flips, 500u);
    EXPECT_GT(num_self_glued, 5u);
    EXPECT_GT(num_loops, 5u);
}

TEST(FaceOperations, AFaceGluedToItselfIsSplitAlongTheSeam) {
    Index num_seams = 0;
    for_each_mesh([&](const TriangleMesh&, const Surface& input, std::uint64_t) {
        const IntrinsicTriangulation base(input);
        for (Index h = 0; h < base.surface().twin.size(); ++h) {
            const Index twin = base.surface().twin[h];
            if (twin == no_index || Surface::face(twin) != Surface::face(h)) continue;
            ++num_seams;
            Surface split = base.surface();
            detail::FaceCharts charts(split);
            split.mesh.positions.emplace_back(Vec3::Zero());
            split.outgoing.push_back(no_index);
            split.can_be_pseudo_source.push_back(0);
            (void)detail::split_edge(split, charts, h, 0.5, split.num_vertices() - 1);
            expect_consistent(split);
            EXPECT_EQ(split.num_faces(), base.surface().num_faces() + 2);
            EXPECT_NEAR(area_of(split), area_of(input), 1e-11 * area_of(input));
        }
    });
    EXPECT_GT(num_seams, 10u);
}

// The first component goes, so that the last faces of the second take its numbers.
TEST(CompactFaces, AFaceGluedToItselfStaysSoUnderItsNewNumber) {
    const TriangleMesh gone = shapes::icosahedron();
    const auto num_gone = static_cast<Index>(gone.triangles.size());
    Index num_moved = 0;
    for_each_mesh([&](const TriangleMesh& mesh, const Surface&, std::uint64_t) {
        const Surface input = build_surface(shapes::join(gone, mesh).view());
        Surface s = IntrinsicTriangulation(input).surface();
        const double area = area_of(s);
        const Index num_left = s.num_faces() - num_gone;
        double area_gone = 0;
        for (Index f = 0; f < num_gone; ++f) area_gone += face_area(s, f);
        for (Index h = 0; h < 3 * num_gone; ++h) {
            s.outgoing[s.tail(h)] = no_index;
            s.edge_half[s.edge[h]] = no_index;
        }
        for (Index f = 0; f < num_gone; ++f) detail::bury(s, f);
        for (Index h = 3 * num_left; h < s.twin.size(); ++h) {
            if (s.twin[h] != no_index && Surface::face(s.twin[h]) == Surface::face(h)) ++num_moved;
        }
        detail::FaceHistory history(input.num_faces());
        detail::compact_faces(s, history);
        expect_consistent(s);
        EXPECT_EQ(s.num_faces(), num_left);
        EXPECT_NEAR(area_of(s), area - area_gone, 1e-12 * area);
    });
    EXPECT_GT(num_moved, 5u);
}

TEST(IntrinsicTriangulation, IsConsistentDelaunayAndOfTheSameArea) {
    for_each_mesh([](const TriangleMesh&, const Surface& input, std::uint64_t seed) {
        const IntrinsicOptions options = options_of(input, seed);
        const IntrinsicTriangulation base(input, options);
        const Surface& s = base.surface();
        expect_consistent(s);
        EXPECT_TRUE(base.counts().is_delaunay);
        EXPECT_EQ(s.num_vertices(), input.num_vertices() + base.counts().splits);
        EXPECT_NEAR(area_of(s), area_of(input), 1e-11 * area_of(input));
        for (Index h = 0; h < s.twin.size(); ++h) {
            if (s.twin[h] == no_index || Surface::face(s.twin[h]) == Surface::face(h)) continue;
            EXPECT_TRUE(is_delaunay_at(s, h)) << h;
        }
        if (options.max_length == std::numeric_limits<double>::infinity()) return;
        EXPECT_LE(shapes::longest_edge(s), options.max_length);
        const double squares = area_of(input) / (options.max_length * options.max_length);
        double boundary = 0;
        for (Index e = 0; e < input.num_edges(); ++e) {
            if (input.twin[input.edge_half[e]] == no_index) boundary += input.length[e];
        }
        EXPECT_LE(s.num_faces(), 8 * (input.num_faces() + squares + boundary / options.max_length));
    });
}

// Corners of a quad on one circle: both diagonals are Delaunay.
TEST(IntrinsicTriangulation, OfTwoDelaunayDiagonalsTheShorterOneIsTaken) {
    const std::vector<Vec3> corners{{-1, 0, 0}, {0.6, -0.8, 0}, {1, 0, 0}, {0.6, 0.8, 0}};
    for (const bool is_long : {false, true}) {
        const TriangleMesh mesh{corners, is_long ? std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}
                                                 : std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}}};
        const Surface input = build_surface(mesh.view());
        const IntrinsicTriangulation base(input);
        EXPECT_EQ(base.is_changed(0), is_long);
        const Surface& s = base.surface();
        for (Index h = 0; h < s.twin.size(); ++h) {
            if (s.twin[h] == no_index) continue;
            EXPECT_NEAR(s.length_of(h), 1.6, 1e-12);
        }
    }
}

TEST(IntrinsicTriangulation, PointsGoToTheBaseAndBack) {
    Index num_points = 0;
    for_each_mesh([&](const TriangleMesh& mesh, const Surface& input, std::uint64_t seed) {
        const IntrinsicTriangulation base(input, options_of(input, seed));
        const double rounding = 1e-13 * diagonal(mesh);
        Dice dice(seed);
        for (Index i = 0; i < 120; ++i, ++num_points) {
            const SurfacePoint point = points::anywhere(dice, dice.count(0, input.num_faces() - 1));
            const SurfacePoint there = base.to_intrinsic(point);
            double sum = 0;
            for (const double b : there.barycentric) {
                EXPECT_GE(b, 0);
                sum += b;
            }
            EXPECT_NEAR(sum, 1, 1e-15);
            expect_same_place(input, base.to_input(there), point, rounding);
        }
    });
    EXPECT_GE(num_points, 10000u);
}

TEST(IntrinsicTriangulation, VerticesAndBoundaryEdgesKeepExactZeros) {
    for_each_mesh([](const TriangleMesh& mesh, const Surface& input, std::uint64_t seed) {
        const IntrinsicTriangulation base(input, options_of(input, seed));
        const double size = diagonal(mesh);
        for (Index v = 0; v < input.num_vertices(); ++v) {
            const SurfacePoint there = base.to_intrinsic(point_at(input, v));
            if (base.surface().outgoing[v] == no_index) {  // Not a vertex there.
                expect_same_place(input, base.to_input(there), point_at(input, v), 1e-13 * size);
                continue;
            }
            EXPECT_EQ(*std::max_element(there.barycentric.begin(), there.barycentric.end()), 1);
            EXPECT_EQ(vertex_of(base.surface(), there), v);
            const SurfacePoint back = base.to_input(point_at(base.surface(), v));
            EXPECT_EQ(*std::max_element(back.barycentric.begin(), back.barycentric.end()), 1);
            EXPECT_EQ(vertex_of(input, back), v);
        }
        for (Index h = 0; h < input.twin.size(); ++h) {
            if (input.twin[h] != no_index) continue;
            for (const double at : {0.1, 0.37, 0.8}) {
                SurfacePoint point{FaceId(Surface::face(h)), {0, 0, 0}};
                point.barycentric[h % 3] = 1 - at;
                point.barycentric[Surface::next(h) % 3] = at;
                EXPECT_TRUE(is_on_boundary(base.surface(), base.to_intrinsic(point)));
                const auto b = base.to_intrinsic(point).barycentric;
                EXPECT_EQ(std::min({b[0], b[1], b[2]}), 0);
            }
        }
        for (Index f = 0; f < base.surface().num_faces(); ++f) {
            if (base.is_changed(f)) continue;
            const SurfacePoint point{FaceId(f), {0.1, 0.2, 0.7}};
            EXPECT_EQ(base.to_input(point).face, point.face);
            EXPECT_EQ(base.to_input(point).barycentric, point.barycentric);
            EXPECT_EQ(base.to_intrinsic(point).barycentric, point.barycentric);
        }
    });
}

TEST(IntrinsicTriangulation, SegmentsJoinAndKeepTheirLengths) {
    Index num_segments = 0;
    for_each_mesh([&](const TriangleMesh& mesh, const Surface& input, std::uint64_t seed) {
        const IntrinsicTriangulation base(input, options_of(input, seed));
        const Surface& s = base.surface();
        const double size = diagonal(mesh);
        Dice dice(seed);
        for (int n = 0; n < 16; ++n) {
            const Index face = dice.count(0, s.num_faces() - 1);
            const SurfacePoint begin = points::anywhere(dice, face);
            const SurfacePoint end = points::anywhere(dice, face);
            std::vector<SurfacePoint> parts;
            base.to_input(begin, end, parts);
            ASSERT_GE(parts.size(), 2u);
            ASSERT_EQ(parts.size() % 2, 0u);
            double sum = 0;
            for (std::size_t i = 0; i < parts.size(); i += 2) {
                ASSERT_EQ(parts[i].face, parts[i + 1].face);
                sum += face_distance(input, parts[i], parts[i + 1]);
            }
            EXPECT_NEAR(sum, face_distance(s, begin, end), 1e-12 * size);
            for (std::size_t i = 1; i + 1 < parts.size(); i += 2) {
                expect_same_place(input, parts[i], parts[i + 1], 1e-13 * size);
            }
            ++num_segments;
        }
    });
    EXPECT_GE(num_segments, 1000u);
}

TEST(IntrinsicTriangulation, FlatVerticesWithShortEdgesGo) {
    Index num_added = 0, num_left = 0;
    for_each_mesh([&](const TriangleMesh& mesh, const Surface& input, std::uint64_t seed) {
        if (!has_flat_vertices(seed)) return;
        num_added += 30;
        const IntrinsicTriangulation base(input, {.min_length = 10 * diagonal(mesh)});
        const Surface& s = base.surface();
        expect_consistent(s);
        Index num_gone = 0;
        for (Index v = 0; v < input.num_vertices(); ++v) {
            if (s.outgoing[v] != no_index) continue;
            ++num_gone;
            double angle = 0;
            for_each_outgoing(input, v, [&](Index h) {
                angle += std::atan2(input.apex[h].y(), input.apex[h].x());
            });
            EXPECT_NEAR(angle, 2 * std::acos(-1.0), 1e-11);
            EXPECT_FALSE(input.is_boundary_vertex(v));
        }
        EXPECT_EQ(base.counts().removed, num_gone);
        EXPECT_EQ(s.num_faces() + 2 * num_gone, input.num_faces());
        num_left += 30 - std::min<Index>(num_gone, 30);
    });
    EXPECT_LT(10 * num_left, 3 * num_added);  // Those on the boundary stay.
    const Surface input = build_surface(shapes::cube().view());
    EXPECT_EQ(IntrinsicTriangulation(input, {.min_length = 10}).counts().removed, 0u);
}

// Once few vertices are left around it, a face has some of them at two corners.
TEST(IntrinsicTriangulation, AroundATubeVerticesGoThatNoFaceHoldsTwice) {
    for (const Index n : {3, 4}) {
        for (const Index m : {4, 12, 20, 60}) {
            SCOPED_TRACE(std::to_string(n) + " " + std::to_string(m));
            const Surface input = build_surface(shapes::tube(n, m).view());
            const IntrinsicTriangulation base(input, {.min_length = 100});
            const Surface& s = base.surface();
            expect_consistent(s);
            EXPECT_EQ(s.num_faces() + 2 * base.counts().removed, input.num_faces());
            EXPECT_GT(base.counts().removed, n * (m - 1) / 2);
            EXPECT_NEAR(area_of(s), area_of(input), 1e-12 * area_of(input));
        }
    }
}

TEST(IntrinsicTriangulation, PartsOfMergedFacesMakeUpTheirArea) {
    Index num_faces = 0;
    for_each_mesh([&](const TriangleMesh&, const Surface& input, std::uint64_t seed) {
        if (!has_flat_vertices(seed)) return;
        const IntrinsicTriangulation base(input, options_of(input, seed));
        for (Index f = 0; f < base.surface().num_faces(); ++f) {
            if (!base.is_changed(f)) continue;
            const std::vector<InputPart> parts = base.parts_of(f);
            if (parts.empty()) continue;
            double area = 0;
            for (const InputPart& part : parts) {
                area += part.share * face_area(input, part.centroid.face.value());
            }
            EXPECT_NEAR(area, face_area(base.surface(), f), 1e-12 * area_of(input));
            ++num_faces;
        }
    });
    EXPECT_GE(num_faces, 200u);
}

TEST(IntrinsicTriangulation, EdgesAreMeasuredInTheirUnit) {
    const Surface input = build_surface(shapes::grid(6).view());
    const auto unit_of = [](const Vec3& at) { return 0.05 + 0.2 * at.x(); };
    const auto unit_at = [&](const SurfacePoint& point) {
        return unit_of(position(input.mesh.view(), point));
    };
    const IntrinsicTriangulation base(input, {.max_length = 0.8, .unit_at = unit_at});
    const Surface& s = base.surface();
    Index num_left = 0, num_right = 0;
    for (const Index h : s.edge_half) {
        const Vec3 &a = s.mesh.positions[s.tail(h)], &b = s.mesh.positions[s.head(h)];
        EXPECT_LE(s.length_of(h), 0.8 * (unit_of(a) + unit_of(b)) / 2 + 1e-12);
        ++(a.x() < 0.3 ? num_left : num_right);
    }
    EXPECT_GT(num_left, num_right);
    // A unit that is the same everywhere is a factor.
    const auto two = [](const SurfacePoint&) { return 2.0; };
    const IntrinsicTriangulation by_unit(input, {.max_length = 0.05, .unit_at = two});
    const IntrinsicTriangulation plain(input, {.max_length = 0.1});
    EXPECT_EQ(by_unit.surface().mesh.positions, plain.surface().mesh.positions);
    EXPECT_EQ(by_unit.surface().mesh.triangles, plain.surface().mesh.triangles);
}

TEST(IntrinsicTriangulation, SplitsEndAtTheirBoundLongestFirst) {
    const Surface input = build_surface(shapes::cube().view());
    const double longest = shapes::longest_edge(input);
    const double length = 0.1 * longest;
    Index all = IntrinsicTriangulation(input, {.max_length = length}).counts().splits;
    ASSERT_GT(all, 100u);
    for (const Index most : {0U, 1U, 7U, 100U}) {
        const IntrinsicTriangulation base(input, {.max_length = length, .most_splits = most});
        EXPECT_EQ(base.counts().splits, most);
        EXPECT_EQ(base.surface().num_vertices(), input.num_vertices() + most);
        EXPECT_TRUE(base.counts().is_delaunay);
        expect_consistent(base.surface());
    }
    // The first splits are of diagonals: none is left with as many as the cube has.
    const IntrinsicTriangulation six(input, {.max_length = length, .most_splits = 6});
    EXPECT_LT(shapes::longest_edge(six.surface()), 0.8 * longest);
    EXPECT_EQ(IntrinsicTriangulation(input, {.max_length = length, .most_splits = all + 1})
                  .counts()
                  .splits,
              all);
}

TEST(IntrinsicTriangulation, NearlyDegenerateFacesAreRaised) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-20, 0}, {0.5, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}};
    const Surface input = build_surface(mesh.view());
    const IntrinsicTriangulation base(input);
    for (const Vec2& apex : base.surface().apex) EXPECT_GT(apex.y(), 1e-16);
    EXPECT_NEAR(area_of(base.surface()), 0.5, 1e-12);
}

TEST(IntrinsicTriangulation, InvalidOptionsThrow) {
    const Surface input = build_surface(shapes::cube().view());
    for (const double length : {0.0, -1.0, std::nan("")}) {
        EXPECT_THROW(IntrinsicTriangulation(input, {.max_length = length}), InvalidOption);
    }
    for (const double length : {-1.0, std::nan("")}) {
        EXPECT_THROW(IntrinsicTriangulation(input, {.min_length = length}), InvalidOption);
    }
}

TEST(IntrinsicTriangulation, IsTheSameForAnyNumberOfThreads) {
    // So many edges that they are several chunks.
    const Surface input = build_surface(shapes::jitter(shapes::torus(160, 80), 0.004, 5).view());
    const IntrinsicTriangulation one(input, {.max_length = 0.06, .num_threads = 1});
    ASSERT_GT(num_changed(one), 100u);
    ASSERT_GT(one.counts().splits, 10u);
    for (const int threads : {2, 8}) {
        const IntrinsicTriangulation other(input, {.max_length = 0.06, .num_threads = threads});
        EXPECT_EQ(num_changed(one), num_changed(other));
        checks::expect_same(one.surface(), other.surface());
    }
}

// So many vertices that they are several parts, with flat ones on the rims of these.
TEST(IntrinsicTriangulation, FlatVerticesGoPartByPartForAnyNumberOfThreads) {
    TriangleMesh mesh = shapes::cube();
    for (int level = 0; level < 6; ++level) mesh = shapes::subdivide(mesh);
    const Surface input = build_surface(mesh.view());
    const double size = diagonal(mesh);
    const IntrinsicTriangulation one(input, {.min_length = size, .num_threads = 1});
    expect_consistent(one.surface());
    EXPECT_GT(one.counts().removed, input.num_vertices() - 100);
    EXPECT_EQ(one.surface().num_faces() + 2 * one.counts().removed, input.num_faces());
    EXPECT_NEAR(area_of(one.surface()), area_of(input), 1e-12 * size * size);
    Dice dice(1);
    for (Index i = 0; i < 2000; ++i) {
        const SurfacePoint point = points::anywhere(dice, dice.count(0, input.num_faces() - 1));
        expect_same_place(input, one.to_input(one.to_intrinsic(point)), point, 1e-13 * size);
    }
    for (const int threads : {2, 8}) {
        const IntrinsicTriangulation other(input, {.min_length = size, .num_threads = threads});
        EXPECT_EQ(num_changed(one), num_changed(other));
        checks::expect_same(one.surface(), other.surface());
    }
}
