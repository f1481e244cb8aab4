// Curves and nodes of small networks, and surfaces cut along them.
#include "remesh/curves/curve_network.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "remesh/curves/curve_sites.h"
#include "support/flag_edges.h"
#include "support/parts.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::no_index;
using agvd::Surface;
using agvd::Vec3;
using remesh::CurveNetwork;

namespace {

constexpr double eps = 1e-12;

using Flags = std::vector<std::uint8_t>;

// Edges of the unit grid whose ends both lie on one of the straight lines between two points that
// run along an axis.
struct Line {
    Vec3 from, to;
};

bool lies_on(const Vec3& point, const Line& line) {
    return (point - line.from).norm() + (point - line.to).norm() <
           (line.to - line.from).norm() + eps;
}

Flags flag_lines(const Surface& surface, const std::vector<Line>& lines) {
    return flag_edges(surface, [&](const Vec3& a, const Vec3& b) {
        return std::any_of(lines.begin(), lines.end(),
                           [&](const Line& line) { return lies_on(a, line) && lies_on(b, line); });
    });
}

// Six steps up the diagonal of a grid of 8 x 8 squares.
Flags flag_steps(const Surface& surface) {
    std::vector<Line> steps;
    for (int i = 1; i < 7; ++i) {
        steps.push_back({Vec3(i / 8., i / 8., 0), Vec3((i + 1) / 8., i / 8., 0)});
        steps.push_back({Vec3((i + 1) / 8., i / 8., 0), Vec3((i + 1) / 8., (i + 1) / 8., 0)});
    }
    return flag_lines(surface, steps);
}

Surface make(const agvd::TriangleMesh& mesh) { return agvd::build_surface(mesh.view()); }

std::set<std::array<double, 2>> places_of_nodes(const Surface& surface,
                                                const CurveNetwork& network) {
    std::set<std::array<double, 2>> places;
    for (const Index v : network.nodes) {
        const Vec3& p = surface.mesh.positions[v];
        places.insert({p.x(), p.y()});
    }
    return places;
}

Index count_creases(const CurveNetwork& network) {
    Index count = 0;
    for (const auto& curve : network.curves) {
        if (curve.is_crease()) ++count;
    }
    return count;
}

// Edges follow one another, both sides tell of the same vertices, and the lengths add up.
void expect_valid(const Surface& surface, const Flags& flags, const CurveNetwork& network) {
    std::vector<int> times(surface.num_edges(), 0);
    for (const auto& curve : network.curves) {
        ASSERT_GE(curve.num_edges(), 1u);
        ASSERT_GE(curve.sides.size(), 1u);
        for (std::size_t side = 0; side < curve.sides.size(); ++side) {
            const bool runs_along = curve.sides[side].runs_along;
            ASSERT_EQ(curve.sides[side].half_edges.size(), curve.num_edges());
            for (std::size_t i = 0; i < curve.num_edges(); ++i) {
                const Index h = curve.sides[side].half_edges[i];
                const Index before = curve.vertex(surface, i, side);
                const Index after = curve.vertex(surface, i + 1, side);
                EXPECT_EQ(before, runs_along ? surface.tail(h) : surface.head(h));
                EXPECT_EQ(after, runs_along ? surface.head(h) : surface.tail(h));
                EXPECT_NEAR(curve.up_to[i + 1] - curve.up_to[i], surface.length_of(h), eps);
            }
        }
        if (curve.is_crease()) {
            for (std::size_t i = 0; i < curve.num_edges(); ++i) {
                EXPECT_EQ(surface.twin[curve.sides[0].half_edges[i]], curve.sides[1].half_edges[i]);
            }
        }
        for (const Index h : curve.sides[0].half_edges) ++times[surface.edge[h]];
        const Index first = curve.vertex(surface, 0);
        const Index last = curve.vertex(surface, curve.num_edges());
        if (curve.is_closed()) {
            EXPECT_EQ(curve.end, no_index);
            EXPECT_EQ(first, last);
        } else {
            EXPECT_EQ(network.nodes[curve.begin], first);
            EXPECT_EQ(network.nodes[curve.end], last);
        }
    }
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const bool is_boundary = surface.twin[surface.edge_half[e]] == no_index;
        EXPECT_EQ(times[e], flags[e] != 0 || is_boundary ? 1 : 0);
    }
    EXPECT_TRUE(std::is_sorted(network.nodes.begin(), network.nodes.end()));
}

CurveNetwork find(const Surface& surface, const Flags& flags, double spacing = 0.25) {
    CurveNetwork network = remesh::find_network(surface, flags, spacing);
    expect_valid(surface, flags, network);
    return network;
}

// The corners of the unit square and these.
std::set<std::array<double, 2>> square_and(std::set<std::array<double, 2>> more) {
    more.insert({{0, 0}, {1, 0}, {0, 1}, {1, 1}});
    return more;
}

// Faces, half-edges and lengths of before; each vertex knows what it is a copy of.
void expect_valid(const Surface& whole, const Flags& flags, const remesh::CutSurface& cut) {
    const Surface& surface = cut.surface();
    ASSERT_EQ(surface.num_faces(), whole.num_faces());
    ASSERT_EQ(cut.original.size(), surface.num_vertices());
    EXPECT_EQ(cut.num_original, whole.num_vertices());
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        if (v < cut.num_original) {
            EXPECT_EQ(cut.original[v], v);
        }
        EXPECT_EQ(surface.mesh.positions[v], whole.mesh.positions[cut.original[v]]);
        ASSERT_NE(surface.outgoing[v], no_index);
        EXPECT_EQ(surface.tail(surface.outgoing[v]), v);
    }
    for (Index h = 0; h < whole.twin.size(); ++h) {
        EXPECT_EQ(cut.original[surface.tail(h)], whole.tail(h));
        EXPECT_EQ(surface.length_of(h), whole.length_of(h));
        const bool is_cut = flags[whole.edge[h]] != 0;
        EXPECT_EQ(surface.twin[h], is_cut ? no_index : whole.twin[h]);
    }
    const remesh::Topology topology = remesh::analyze_topology(surface.mesh.view());
    EXPECT_TRUE(topology.is_manifold);
    EXPECT_TRUE(topology.is_oriented);
}

remesh::CutSurface cut(const Surface& surface, const Flags& flags) {
    remesh::CutSurface result = remesh::cut_surface(surface, flags);
    expect_valid(surface, flags, result);
    return result;
}

std::vector<int> boundary_loops_of(const remesh::CutSurface& cut) {
    std::vector<int> loops;
    for (const auto& c : remesh::analyze_topology(cut.surface().mesh.view()).components) {
        EXPECT_EQ(c.genus, 0);
        loops.push_back(c.boundary_loops);
    }
    std::sort(loops.begin(), loops.end());
    return loops;
}

}  // namespace

TEST(CurveNetwork, ACubeHasEightNodesAndTwelveCurves) {
    const Surface surface = make(parts::box({1, 1, 1}, 4));
    const CurveNetwork network = find(surface, flag_sharp_edges(surface));
    ASSERT_EQ(network.nodes.size(), 8u);
    ASSERT_EQ(network.curves.size(), 12u);
    for (const Index v : network.nodes) {
        for (const double x : surface.mesh.positions[v]) EXPECT_TRUE(x == 0 || x == 1);
    }
    for (const auto& curve : network.curves) {
        EXPECT_EQ(curve.num_edges(), 4u);
        EXPECT_NEAR(curve.length(), 1, eps);
        EXPECT_FALSE(curve.is_closed());
        EXPECT_NE(curve.begin, curve.end);
    }
}

TEST(CurveNetwork, AClosedCreaseHasNoNodes) {
    const Surface surface = make(parts::capped_cylinder(32, 4));
    const CurveNetwork network = find(surface, flag_sharp_edges(surface));
    EXPECT_TRUE(network.nodes.empty());
    ASSERT_EQ(network.curves.size(), 2u);
    for (const auto& curve : network.curves) {
        EXPECT_TRUE(curve.is_closed());
        EXPECT_NEAR(curve.length(), 64 * std::sin(std::numbers::pi / 32), eps);
    }
}

TEST(CurveNetwork, ASmoothSurfaceHasItsBoundaryOnly) {
    const Surface square = make(shapes::grid(8));
    const CurveNetwork of_square = find(square, Flags(square.num_edges(), 0));
    EXPECT_EQ(places_of_nodes(square, of_square), square_and({}));
    EXPECT_EQ(of_square.curves.size(), 4u);
    EXPECT_EQ(count_creases(of_square), 0u);
    const Surface sphere = make(shapes::sphere(2));
    EXPECT_TRUE(find(sphere, Flags(sphere.num_edges(), 0)).curves.empty());
}

TEST(CurveNetwork, ACreaseMayEndInNothing) {
    const Surface surface = make(shapes::grid(8));
    const Flags flags = flag_lines(surface, {{Vec3(.25, .5, 0), Vec3(.75, .5, 0)}});
    const CurveNetwork network = find(surface, flags);
    EXPECT_EQ(places_of_nodes(surface, network), square_and({{.25, .5}, {.75, .5}}));
    EXPECT_EQ(network.curves.size(), 5u);
    EXPECT_EQ(count_creases(network), 1u);
}

TEST(CurveNetwork, WhereACreaseEndsOnTheBoundaryBothEnd) {
    const Surface surface = make(shapes::grid(8));
    const Flags flags = flag_lines(surface, {{Vec3(0, .5, 0), Vec3(.5, .5, 0)}});
    const CurveNetwork network = find(surface, flags);
    EXPECT_EQ(places_of_nodes(surface, network), square_and({{0, .5}, {.5, .5}}));
    EXPECT_EQ(network.curves.size(), 6u);
}

TEST(CurveNetwork, SeveralCreasesMayMeetInAVertex) {
    const Surface surface = make(shapes::grid(8));
    const Flags flags = flag_lines(
        surface, {{Vec3(.25, .5, 0), Vec3(.75, .5, 0)}, {Vec3(.5, .25, 0), Vec3(.5, .75, 0)}});
    const CurveNetwork network = find(surface, flags);
    EXPECT_EQ(places_of_nodes(surface, network),
              square_and({{.5, .5}, {.25, .5}, {.75, .5}, {.5, .25}, {.5, .75}}));
    EXPECT_EQ(count_creases(network), 4u);
}

TEST(CurveNetwork, ATurnOfACreaseIsANode) {
    const Surface surface = make(shapes::grid(8));
    const Flags flags = flag_lines(
        surface, {{Vec3(.25, .25, 0), Vec3(.75, .25, 0)}, {Vec3(.75, .25, 0), Vec3(.75, .75, 0)}});
    const CurveNetwork network = find(surface, flags);
    EXPECT_EQ(places_of_nodes(surface, network), square_and({{.25, .25}, {.75, .25}, {.75, .75}}));
    EXPECT_EQ(count_creases(network), 2u);
}

TEST(CurveNetwork, StepsFinerThanTheSpacingAreNoTurns) {
    const Surface surface = make(shapes::grid(8));
    const Flags flags = flag_steps(surface);
    const CurveNetwork coarse = find(surface, flags, 0.8);
    EXPECT_EQ(count_creases(coarse), 1u);
    EXPECT_EQ(places_of_nodes(surface, coarse), square_and({{.125, .125}, {.875, .875}}));
    EXPECT_EQ(count_creases(find(surface, flags, 0.1)), 12u);
}

// Sites eight times as close in the left half: there steps are turns.
TEST(CurveNetwork, TurnsAreThoseAtTheSpacingOfTheirPlace) {
    const Surface surface = make(shapes::grid(8));
    const auto unit = [&](const agvd::SurfacePoint& point) {
        return position(surface.mesh.view(), point).x() < 0.45 ? 1. : 8.;
    };
    const CurveNetwork network =
        remesh::find_network(surface, flag_steps(surface), 0.1, {}, {}, unit);
    EXPECT_EQ(
        places_of_nodes(surface, network),
        square_and(
            {{.125, .125}, {.25, .125}, {.25, .25}, {.375, .25}, {.375, .375}, {.875, .875}}));
}

TEST(CurveNetwork, TheTurnsOfAClosedCreaseAreNodesAsFarAsTheSpacingTellsThemApart) {
    const Surface surface = make(shapes::grid(8));
    const auto square = [](double low, double high) {
        const Vec3 a(low, low, 0), b(high, low, 0), c(high, high, 0), d(low, high, 0);
        return std::vector<Line>{{a, b}, {b, c}, {c, d}, {d, a}};
    };
    const Flags flags = flag_lines(surface, square(.25, .75));
    const CurveNetwork fine = find(surface, flags);
    EXPECT_EQ(count_creases(fine), 4u);
    EXPECT_EQ(places_of_nodes(surface, fine),
              square_and({{.25, .25}, {.75, .25}, {.75, .75}, {.25, .75}}));
    // Two opposite ones, then one.
    for (const Index num_turns : {2u, 1u}) {
        const CurveNetwork coarse = find(surface, flags, num_turns == 2 ? 1.5 : 2.5);
        EXPECT_EQ(count_creases(coarse), num_turns);
        for (const auto& curve : coarse.curves) {
            if (!curve.is_crease()) continue;
            EXPECT_FALSE(curve.is_closed());
            EXPECT_EQ(curve.begin == curve.end, num_turns == 1);
            EXPECT_NEAR(curve.length(), 2. / num_turns, eps);
        }
    }
}

// A loop of n edges turns by 360 / n degrees at each vertex.
TEST(CurveNetwork, TurnsFrom45DegreesOnAreNodesAndThoseFrom25BetweenStraightSides) {
    const auto count_nodes = [](Index sides, double edges_per_spacing) {
        const Surface surface = make(shapes::tube(sides, 1));
        const double edge = 2 * std::sin(std::numbers::pi / sides);
        return find(surface, Flags(surface.num_edges(), 0), edges_per_spacing * edge).nodes.size();
    };
    for (const Index sides : {7u, 8u}) EXPECT_EQ(count_nodes(sides, 1.5), 2 * sides);
    for (const Index sides : {9u, 12u, 14u}) {
        EXPECT_EQ(count_nodes(sides, 0.8), 2 * sides);
        EXPECT_EQ(count_nodes(sides, 1.2), 0u);
    }
    EXPECT_EQ(count_nodes(15, 0.25), 0u);
}

TEST(CurveNetwork, PlacesOfACurveAreTheSameOnBothSides) {
    const Surface surface = make(parts::capped_cylinder(32, 4));
    const CurveNetwork network = find(surface, flag_sharp_edges(surface));
    for (const auto& curve : network.curves) {
        const double edge = curve.length() / 32;
        for (const double along : {0., .3 * edge, edge, 2.5 * edge, 31.9 * edge, 32 * edge}) {
            const auto at = [&](double place, std::size_t side) -> Vec3 {
                return position(surface.mesh.view(), remesh::point_on_curve(curve, place, side));
            };
            const Vec3 here = at(along, 0);
            EXPECT_LT((at(along, 1) - here).norm(), eps);
            EXPECT_LT((at(along + curve.length(), 0) - here).norm(), eps);
            EXPECT_LT((at(along - 2 * curve.length(), 1) - here).norm(), eps);
        }
        // On the third edge the way is straight.
        const auto at = [&](double place) -> Vec3 {
            return position(surface.mesh.view(), remesh::point_on_curve(curve, place, 1));
        };
        const Vec3 tangent = remesh::tangent_of_curve(surface, curve, 2.5 * edge);
        EXPECT_LT(((at(2.7 * edge) - at(2.2 * edge)) / (.5 * edge) - tangent).norm(), 1e-9);
        const Index third = curve.vertex(surface, 2);
        EXPECT_LT((at(2 * edge) - surface.mesh.positions[third]).norm(), eps);
    }
}

TEST(CurveNetwork, AnEdgeBelowTheRoundingOfItsCurveHasPlacesToo) {
    const Surface surface = make(parts::box({1, 1, 1}, 4));
    const CurveNetwork network = find(surface, flag_sharp_edges(surface));
    auto curve = network.curves[0];
    const Index before = curve.vertex(surface, static_cast<Index>(curve.num_edges() - 1));
    curve.up_to[curve.num_edges() - 1] = curve.length();
    const auto end = remesh::point_on_curve(curve, curve.length());
    EXPECT_EQ(position(surface.mesh.view(), end), surface.mesh.positions[before]);
    const std::vector<double> spacings = remesh::spacings_along(surface, curve, .25);
    EXPECT_NEAR(spacings.back(), 4, 1e-9);
    EXPECT_EQ(remesh::share_before(3, 2, 6), .25);
    EXPECT_EQ(remesh::share_before(3, 3, 3), 0);
}

TEST(CurveNetwork, PlacesBeyondAnOpenCurveAreItsEnds) {
    const Surface surface = make(parts::box({1, 1, 1}, 4));
    const CurveNetwork network = find(surface, flag_sharp_edges(surface));
    for (const auto& curve : network.curves) {
        const auto at = [&](double place) -> Vec3 {
            return position(surface.mesh.view(), remesh::point_on_curve(curve, place));
        };
        EXPECT_EQ(at(-1), surface.mesh.positions[network.nodes[curve.begin]]);
        EXPECT_EQ(at(7), surface.mesh.positions[network.nodes[curve.end]]);
        const Vec3 way = at(1) - at(0);
        EXPECT_LT((remesh::tangent_of_curve(surface, curve, .6) - way).norm(), 1e-9);
    }
}

TEST(CutSurface, ACubeFallsIntoSixSquares) {
    const Surface surface = make(parts::box({1, 1, 1}, 4));
    const auto result = cut(surface, flag_sharp_edges(surface));
    EXPECT_EQ(boundary_loops_of(result), std::vector<int>(6, 1));
    // Two more copies of each corner, one more of each of 36 vertices.
    EXPECT_EQ(result.surface().num_vertices(), surface.num_vertices() + 8 * 2 + 36);
}

TEST(CutSurface, ACylinderFallsIntoItsCapsAndATube) {
    const Surface surface = make(parts::capped_cylinder(32, 4));
    const auto result = cut(surface, flag_sharp_edges(surface));
    EXPECT_EQ(boundary_loops_of(result), std::vector<int>({1, 1, 2}));
    EXPECT_EQ(result.surface().num_vertices(), surface.num_vertices() + 64);
}

TEST(CutSurface, TheEndsOfASlitStayWhole) {
    const Surface surface = make(shapes::grid(8));
    const auto result = cut(surface, flag_lines(surface, {{Vec3(.25, .5, 0), Vec3(.75, .5, 0)}}));
    EXPECT_EQ(boundary_loops_of(result), std::vector<int>{2});
    EXPECT_EQ(result.surface().num_vertices(), surface.num_vertices() + 3);
}

TEST(CutSurface, ACutFromTheBoundaryOpensIt) {
    const Surface surface = make(shapes::grid(8));
    const auto result = cut(surface, flag_lines(surface, {{Vec3(0, .5, 0), Vec3(.5, .5, 0)}}));
    EXPECT_EQ(boundary_loops_of(result), std::vector<int>{1});
    EXPECT_EQ(result.surface().num_vertices(), surface.num_vertices() + 4);
    const auto across = cut(surface, flag_lines(surface, {{Vec3(0, .5, 0), Vec3(1, .5, 0)}}));
    EXPECT_EQ(boundary_loops_of(across), std::vector<int>({1, 1}));
}

TEST(CutSurface, AVertexHasACopyForEachWedge) {
    const Surface surface = make(shapes::grid(8));
    const auto result = cut(surface, flag_lines(surface, {{Vec3(.25, .5, 0), Vec3(.75, .5, 0)},
                                                          {Vec3(.5, .25, 0), Vec3(.5, .75, 0)}}));
    // Three more of the middle, and one more of each vertex in the middle of an arm.
    EXPECT_EQ(result.surface().num_vertices(), surface.num_vertices() + 3 + 4);
    EXPECT_EQ(boundary_loops_of(result), std::vector<int>{2});
}

TEST(CutSurface, NothingToCutChangesNothing) {
    const Surface surface = make(shapes::torus(12, 8));
    const auto result = remesh::cut_surface(surface, Flags(surface.num_edges(), 0));
    EXPECT_EQ(&result.surface(), &surface);
}
