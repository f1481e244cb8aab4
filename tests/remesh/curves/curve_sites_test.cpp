// Sites on the curves of a network, and the edges that join them.
#include "remesh/curves/curve_sites.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <set>

#include "agvd/mesh/topology.h"
#include "support/flag_edges.h"
#include "support/parts.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Surface;
using agvd::SurfacePoint;
using agvd::Triangle;
using agvd::Vec3;
using remesh::ChainEdge;
using remesh::Curve;
using remesh::CurveSites;
using remesh::DirectedEdge;

namespace {

// A surface, its network and sites on it.
struct Placed {
    Placed(const agvd::TriangleMesh& mesh, const auto& choose, double spacing)
        : surface(agvd::build_surface(mesh.view())) {
        const std::vector<std::uint8_t> flags = choose(surface);
        network = remesh::find_network(surface, flags, spacing);
        cut = remesh::cut_surface(surface, flags);
        intervals = remesh::curve_intervals(surface, network, spacing);
        sites = remesh::curve_sites_at(
            network, cut, remesh::even_positions(cut.surface(), network, spacing, intervals));
        chain = remesh::chain_edges(network, cut, sites);
    }

    [[nodiscard]] Vec3 at(Index site) const {
        return position(cut.surface().mesh.view(), sites.sites[site]);
    }

    Surface surface;
    remesh::CurveNetwork network;
    remesh::CutSurface cut;
    std::vector<Index> intervals;
    CurveSites sites;
    std::vector<ChainEdge> chain;
};

Placed on_box(double spacing) { return {parts::box({1, 1, 1}, 4), flag_sharp_edges, spacing}; }

Placed on_cylinder(double spacing) {
    return {parts::capped_cylinder(32, 4), flag_sharp_edges, spacing};
}

// A crease from (1/4, 1/2) to (3/4, 1/2) that ends in nothing on both sides.
Placed on_slit(double spacing) {
    const auto choose = [](const Surface& surface) {
        return flag_edges(surface, [](const Vec3& a, const Vec3& b) {
            const auto is_on = [](const Vec3& p) {
                return p.y() == .5 && p.x() >= .25 && p.x() <= .75;
            };
            return is_on(a) && is_on(b);
        });
    };
    return {shapes::grid(8), choose, spacing};
}

std::vector<Placed> all() {
    return {on_box(.5), on_box(.2), on_cylinder(.6), on_slit(.25), on_slit(.1)};
}

}  // namespace

TEST(CurveSites, CountsAreThoseOfTheIntervals) {
    const Placed box = on_box(.5);
    EXPECT_EQ(box.intervals, std::vector<Index>(12, 2));
    EXPECT_EQ(remesh::num_curve_vertices(box.network, box.intervals), 20u);
    EXPECT_EQ(box.sites.num_nodes(), 8u);
    // Three copies of each corner, two of each other.
    EXPECT_EQ(box.sites.sites.size(), 8 * 3 + 12 * 2u);
    const Placed cylinder = on_cylinder(.4);  // 6.27 / 0.4, twice.
    EXPECT_EQ(cylinder.intervals, std::vector<Index>(2, 16));
    EXPECT_EQ(remesh::num_curve_vertices(cylinder.network, cylinder.intervals), 32u);
    for (const Placed& placed : all()) {
        EXPECT_EQ(remesh::num_curve_vertices(placed.network, placed.intervals),
                  placed.sites.num_groups());
        EXPECT_EQ(placed.sites.first_copy.back(), placed.sites.sites.size());
        EXPECT_EQ(placed.sites.first_of_curve.back(), placed.sites.num_groups());
    }
}

TEST(CurveSites, FewIntervalsCanStillBeTriangulated) {
    EXPECT_EQ(on_box(50).intervals, std::vector<Index>(12, 1));
    EXPECT_EQ(remesh::fewest_intervals(on_box(.1).network), std::vector<Index>(12, 1));
    EXPECT_EQ(on_cylinder(50).intervals, std::vector<Index>(2, 3));
    // Both ways around a square from one corner to the other, and a loop from a corner to itself.
    const auto square = [](const Surface& surface) {
        return flag_edges(surface, [](const Vec3& a, const Vec3& b) {
            const auto off = [](const Vec3& p) {
                return std::max(std::abs(p.x() - .5), std::abs(p.y() - .5));
            };
            return off(a) == .25 && off(b) == .25 && off((a + b) / 2) == .25;
        });
    };
    for (const auto& [spacing, expected] : {std::pair(1.5, 2u), {2.5, 3u}}) {
        const Placed placed(shapes::grid(8), square, spacing);
        const std::vector<Index> fewest = remesh::fewest_intervals(placed.network);
        for (std::size_t c = 0; c < fewest.size(); ++c) {
            const Curve& curve = placed.network.curves[c];
            if (!curve.is_crease()) continue;
            EXPECT_EQ(fewest[c], expected);
        }
    }
}

TEST(CurveSites, CopiesLieAtOnePlaceInDifferentWedges) {
    for (const Placed& placed : all()) {
        for (Index g = 0; g < placed.sites.num_groups(); ++g) {
            const Index first = placed.sites.first_copy[g], last = placed.sites.first_copy[g + 1];
            ASSERT_LT(first, last);
            std::set<Index> faces;
            for (Index copy = first; copy < last; ++copy) {
                EXPECT_LT((placed.at(copy) - placed.at(first)).norm(), 1e-12);
                faces.insert(placed.sites.sites[copy].face.value());
            }
            EXPECT_EQ(faces.size(), last - first);
        }
        for (Index i = 0; i < placed.sites.num_nodes(); ++i) {
            EXPECT_EQ(placed.at(placed.sites.first_copy[i]),
                      placed.surface.mesh.positions[placed.network.nodes[i]]);
        }
    }
    // The ends of a slit have one copy.
    const Placed slit = on_slit(.25);
    for (Index i = 0; i < slit.sites.num_nodes(); ++i) {
        EXPECT_EQ(slit.sites.first_copy[i + 1] - slit.sites.first_copy[i], 1u);
    }
}

TEST(CurveSites, StraightCurvesAreDividedEvenly) {
    const Placed box = on_box(.2);
    for (std::size_t c = 0; c < 12; ++c) {
        EXPECT_EQ(box.intervals[c], 5u);
        for (Index i = 0; i < 4; ++i) {
            EXPECT_NEAR(box.sites.along[box.sites.first_of_curve[c] + i], .2 * (i + 1), 1e-12);
        }
    }
}

// The first site of a closed curve lies in the middle of its first edge, which has several here.
TEST(CurveSites, ClosedCurvesAreDividedEvenlyAllAround) {
    const Placed cylinder = on_cylinder(.05);
    ASSERT_EQ(cylinder.network.curves.size(), 2u);
    for (Index c = 0; c < 2; ++c) {
        const Curve& curve = cylinder.network.curves[c];
        ASSERT_TRUE(curve.is_closed());
        const Index first = cylinder.sites.first_of_curve[c];
        const Index last = cylinder.sites.first_of_curve[c + 1];
        ASSERT_GT(last - first, 3 * curve.num_edges());
        const double interval = curve.length() / (last - first);
        double before = cylinder.sites.along[last - 1] - curve.length();
        for (Index g = first; g < last; ++g) {
            EXPECT_NEAR(cylinder.sites.along[g] - before, interval, 1e-9) << g - first;
            before = cylinder.sites.along[g];
        }
    }
}

TEST(CurveSites, BendsHaveMoreSites) {
    const Placed box = on_box(.2);
    for (const Curve& curve : box.network.curves) {
        EXPECT_NEAR(remesh::spacings_along(box.surface, curve, .2).back(), 5, 1e-9);
    }
    // A radian is 57 degrees: twice at most, and once where a spacing turns by less than 30.
    const Placed round = on_cylinder(.3);
    const Curve& circle = round.network.curves[0];
    const double length = circle.length();
    const auto spacings = [&](double spacing) {
        return remesh::spacings_along(round.surface, circle, spacing).back() * spacing / length;
    };
    EXPECT_NEAR(spacings(.3), 1, 1e-9);
    EXPECT_GT(spacings(.8), 1.4);
    EXPECT_LE(spacings(5), 2 + 1e-9);
}

TEST(CurveSites, ChainsRunAlongTheBoundaryOfEachPatch) {
    for (const Placed& placed : all()) {
        Index num_edges = 0;
        for (std::size_t c = 0; c < placed.network.curves.size(); ++c) {
            const Curve& curve = placed.network.curves[c];
            num_edges += placed.intervals[c] * static_cast<Index>(curve.sides.size());
        }
        EXPECT_EQ(placed.chain.size(), num_edges);
        const remesh::Topology patches = remesh::analyze_topology(placed.cut.surface().mesh.view());
        const auto patch = [&](Index site) {
            return patches.face_component[placed.sites.sites[site].face.value()];
        };
        std::map<Index, Index> next;
        for (const ChainEdge& edge : placed.chain) {
            EXPECT_TRUE(next.emplace(edge.from, edge.to).second);
            EXPECT_EQ(patch(edge.from), patch(edge.to));
            EXPECT_LT(edge.interval, placed.intervals[edge.curve]);
            // The surface lies on the left.
            const Vec3 way = placed.at(edge.to) - placed.at(edge.from);
            const Curve& curve = placed.network.curves[edge.curve];
            double along = 0;
            for (const Index site : {edge.from, edge.to}) {
                const auto& copies = placed.sites.first_copy;
                const auto group = static_cast<Index>(
                    std::upper_bound(copies.begin(), copies.end(), site) - copies.begin() - 1);
                if (group >= placed.sites.num_nodes()) along = placed.sites.along[group];
            }
            const Vec3 tangent = tangent_of_curve(placed.surface, curve, along);
            EXPECT_EQ(way.dot(tangent) > 0, curve.sides[edge.side].runs_along);
        }
        // Each copy has one edge that comes and one that goes.
        std::set<Index> heads;
        for (const auto& [from, to] : next) heads.insert(to);
        EXPECT_EQ(next.size(), placed.sites.sites.size());
        EXPECT_EQ(heads.size(), placed.sites.sites.size());
        // As many rounds as the patches have boundaries.
        std::size_t num_loops = 0, expected = 0;
        for (const auto& c : patches.components) {
            expected += static_cast<std::size_t>(c.boundary_loops);
        }
        while (!next.empty()) {
            ++num_loops;
            for (auto it = next.begin(); it != next.end();) {
                const Index to = it->second;
                next.erase(it);
                it = next.find(to);
            }
        }
        EXPECT_EQ(num_loops, expected);
        EXPECT_EQ(remesh::ends_of(placed.chain)[0],
                  DirectedEdge(placed.chain[0].from, placed.chain[0].to));
    }
}

TEST(CurveSites, AllCopiesMoveTogether) {
    Placed box = on_box(.5);
    const Index group = box.sites.first_of_curve[3];
    const Curve& curve = box.network.curves[3];
    const Index first = box.sites.first_copy[group];
    remesh::move_along(curve, group, .7, box.sites);
    const Vec3 expected = position(box.surface.mesh.view(), remesh::point_on_curve(curve, .7));
    EXPECT_EQ(box.sites.along[group], .7);
    EXPECT_LT((box.at(first) - expected).norm(), 1e-12);
    EXPECT_LT((box.at(first + 1) - expected).norm(), 1e-12);
    EXPECT_NE(box.sites.sites[first].face, box.sites.sites[first + 1].face);
}

TEST(CloseRim, TheRimIsWhereTrianglesEnd) {
    const std::vector<Triangle> two{{0, 1, 2}, {0, 2, 3}};
    EXPECT_EQ(remesh::rim_of(two), std::vector<DirectedEdge>({{0, 1}, {1, 2}, {2, 3}, {3, 0}}));
    EXPECT_TRUE(remesh::rim_of({}).empty());
}

TEST(CloseRim, GapsBetweenChainAndRimAreFilled) {
    // The rim goes from 0 to 1 through 5, and from 1 to 2 through 6 and 7.
    const std::vector<Triangle> before{{0, 5, 9}, {5, 1, 9}, {1, 6, 9},
                                       {6, 7, 9}, {7, 2, 9}, {2, 0, 9}};
    std::vector<Triangle> triangles = before;
    const std::vector<DirectedEdge> chain{{0, 1}, {1, 2}, {2, 0}};
    remesh::close_rim(chain, triangles);
    EXPECT_EQ(triangles.size(), before.size() + 3);
    EXPECT_TRUE(std::equal(before.begin(), before.end(), triangles.begin()));
    EXPECT_EQ(remesh::rim_of(triangles), chain);
    remesh::close_rim(chain, triangles);
    EXPECT_EQ(triangles.size(), before.size() + 3);
}

TEST(CloseRim, SitesOfACurveThatTheRimGoesPastGetTriangles) {
    // The rim goes from 1 to 2 at once, the chain through 4 and 5.
    const std::vector<Triangle> before{{0, 1, 9}, {1, 2, 9}, {2, 0, 9}};
    const std::vector<DirectedEdge> chain{{0, 1}, {1, 4}, {2, 0}, {4, 5}, {5, 2}};
    std::vector<Triangle> triangles = before;
    remesh::close_rim(chain, triangles);
    EXPECT_EQ(triangles.size(), before.size() + 2);
    EXPECT_EQ(remesh::rim_of(triangles), chain);
    // Not where such a site has a triangle already: two fans would meet there.
    triangles = before;
    triangles.push_back({4, 7, 8});
    remesh::close_rim(chain, triangles);
    EXPECT_EQ(triangles.size(), before.size() + 1);
}

TEST(CloseRim, WaysThatLeadElsewhereStayOpen) {
    // From 0 the rim never comes to 7, and from 0 to 12 it takes more sites than a gap has.
    std::vector<Triangle> fan;
    for (Index i = 0; i < 13; ++i) fan.push_back({i, (i + 1) % 13, 20});
    const std::vector<Triangle> before = fan;
    remesh::close_rim(std::vector<DirectedEdge>{{0, 30}, {0, 12}}, fan);
    EXPECT_EQ(fan, before);
}
