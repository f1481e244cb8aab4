// Vertices that lie at one place but for rounding.
#include "remesh/clean/soup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "agvd/core/union_find.h"
#include "agvd/mesh/topology.h"
#include "remesh/clean/carry.h"
#include "remesh/clean/clean_input.h"
#include "support/dice.h"
#include "support/dirty_shapes.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::no_index;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::CleanResult;

namespace {

std::vector<Index> places_of(const TriangleMesh& mesh, const std::vector<bool>& is_wanted) {
    agvd::Poller poller{agvd::Progress()};
    agvd::Ticker ticker(poller);
    return remesh::detail::find_common_positions(mesh.view(), is_wanted, ticker).first;
}

Vec3 direction(Dice& dice) {
    return Vec3(dice.number(-1, 1), dice.number(-1, 1), dice.number(-1, 1)).normalized();
}

// Separate triangles with edges of .6 to 1.4 in a box of the given size, and beside the first
// corner of each that of another one at some distance up to `most`.
TriangleMesh pairs_of_triangles(double size, double most, Dice& dice) {
    TriangleMesh mesh;
    for (int i = 0; i < 150; ++i) {
        const Vec3 at(dice.number(0, size), dice.number(0, size), dice.number(0, size));
        const Vec3 along = direction(dice);
        const Vec3 up = along.cross(direction(dice)).normalized();
        for (int copy = 0; copy < 2; ++copy) {
            const auto first = static_cast<Index>(mesh.positions.size());
            mesh.triangles.push_back({first, first + 1, first + 2});
            const double edge = dice.number(0.6, 1.4);
            const Vec3 corner = at + copy * dice.number(0, most) * direction(dice);
            mesh.positions.push_back(corner);
            mesh.positions.push_back(corner + edge * along);
            mesh.positions.push_back(corner + edge * (along / 2 + std::sqrt(3) / 2 * up));
        }
    }
    mesh.positions[0] = Vec3::Zero();
    mesh.positions[1] = Vec3(size, 0, 0);
    return mesh;
}

// A plate of two grids that share a side, but for a gap. The sides of a grid have length 1 and
// `fineness` edges.
TriangleMesh grids_with_gap(Index fineness, double gap) {
    TriangleMesh right = shapes::grid(fineness);
    for (Vec3& p : right.positions) p.x() += 1 + gap;
    return shapes::join(shapes::grid(fineness), right);
}

// A small triangle, so far away that a millionth of the size is `reach`.
TriangleMesh with_size(const TriangleMesh& mesh, double reach) {
    const Vec3 far(1e6 * reach, 0, 0);
    return shapes::join(mesh, {{far, far + Vec3(0, 1, 0), far + Vec3(-1, 0, 0)}, {{0, 1, 2}}});
}

Index num_components(const CleanResult& clean) {
    return static_cast<Index>(remesh::analyze_topology(clean.mesh.view()).components.size());
}

}  // namespace

// Against all pairs. The limit is a millionth of the size in one box, a hundredth of the edges in
// the other.
TEST(Places, AreThoseOfAllPairsWithinReach) {
    Dice dice(1);
    int near = 0, far = 0;
    for (const double size : {2000.0, 50'000.0}) {
        for (int round = 0; round < 20; ++round) {
            const double limit = std::min(1e-6 * size, 0.01);
            const TriangleMesh mesh = pairs_of_triangles(size, 1.5 * limit, dice);
            const std::vector<bool> all(mesh.positions.size(), true);
            agvd::UnionFind sets(mesh.positions.size());
            std::vector<double> reach(mesh.positions.size());
            for (const agvd::Triangle& t : mesh.triangles) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto length = [&](std::size_t i) {
                        return (mesh.positions[t[i]] - mesh.positions[t[(i + 1) % 3]]).norm();
                    };
                    reach[t[k]] = 0.01 * std::min(length(k), length((k + 2) % 3));
                }
            }
            std::vector<double> sorted = reach;
            std::sort(sorted.begin(), sorted.end());
            const double most = std::min(1e-6 * size, sorted[sorted.size() / 2]);
            for (Index a = 0; a < reach.size(); ++a) {
                for (Index b = 0; b < a; ++b) {
                    const double gap = (mesh.positions[a] - mesh.positions[b]).norm();
                    const bool is_near = gap <= std::min({most, reach[a], reach[b]});
                    if (is_near) (void)sets.unite(a, b);
                    if (gap <= 2 * limit) ++(is_near ? near : far);
                }
            }
            const std::vector<Index> place = places_of(mesh, all);
            for (Index v = 0; v < place.size(); ++v) ASSERT_EQ(place[v], sets.root(v)) << v;
        }
    }
    EXPECT_GT(near, 2000);
    EXPECT_GT(far, 2000);
}

TEST(Places, OnlyWantedVerticesHaveOne) {
    const TriangleMesh mesh = grids_with_gap(4, 1e-9);
    std::vector<bool> is_wanted(mesh.positions.size(), true);
    is_wanted[7] = false;
    const std::vector<Index> place = places_of(mesh, is_wanted);
    EXPECT_EQ(place[7], no_index);
    EXPECT_EQ(place[6], 6u);
    EXPECT_TRUE(places_of(mesh, std::vector<bool>(mesh.positions.size(), false)) ==
                std::vector<Index>(mesh.positions.size(), no_index));
}

TEST(Places, RoundedSoupsBecomeTheSurface) {
    const TriangleMesh model = shapes::torus(40, 30);
    const TriangleMesh soup = shapes::jitter(shapes::unweld(model), 1e-8, 3);
    const CleanResult clean = remesh::clean_input(soup.view());
    EXPECT_TRUE(remesh::same_topology(remesh::analyze_topology(clean.mesh.view()),
                                      remesh::analyze_topology(model.view())));
    EXPECT_EQ(clean.mesh.positions.size(), model.positions.size());
    EXPECT_EQ(clean.counts.welded_vertices, soup.positions.size() - model.positions.size());
    ASSERT_EQ(clean.welded_positions.size(), soup.positions.size());
    for (Index f = 0; f < soup.triangles.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& at = clean.mesh.positions[clean.mesh.triangles[f][k]];
            EXPECT_EQ(clean.welded_positions[soup.triangles[f][k]], at);
            EXPECT_LE((soup.positions[soup.triangles[f][k]] - at).norm(), 1e-7);
        }
    }
}

TEST(Places, GapsWithinBothLimitsClose) {
    // Edges of 1/8, so that the hundredth is .00125.
    struct Case {
        double gap, millionth;
        Index components;  // The far triangle is one.
    };
    for (const Case& c : {Case{0.0012, 0.01, 2}, Case{0.0013, 0.01, 3}, Case{0.0004, 0.0005, 2},
                          Case{0.0006, 0.0005, 3}}) {
        const TriangleMesh mesh = with_size(grids_with_gap(8, c.gap), c.millionth);
        EXPECT_EQ(num_components(remesh::clean_input(mesh.view())), c.components)
            << c.gap << ' ' << c.millionth;
    }
}

// An edge of length 0 does not keep a gap open.
TEST(Places, EdgesWithoutLengthDoNotCount) {
    const TriangleMesh mesh{
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1e-7, 0, 0}, {-1, 1, 0}, {-1, 0, 0}, {0, 0, 0}},
        {{0, 1, 2}, {3, 4, 5}, {0, 6, 1}}};
    EXPECT_EQ(places_of(mesh, std::vector<bool>(7, true)),
              (std::vector<Index>{0, 1, 2, 0, 4, 5, 0}));
}

// Two grids whose corners lie within reach, and no edge of theirs.
TEST(Places, PartsThatNearlyTouchAtAPointStayAsTheyAre) {
    TriangleMesh other = shapes::grid(4);
    for (Vec3& p : other.positions) p += Vec3(1 + 1e-9, 1, 0);
    const TriangleMesh mesh = shapes::join(shapes::grid(4), other);
    const CleanResult clean = remesh::clean_input(mesh.view());
    EXPECT_EQ(clean.mesh.positions, mesh.positions);
    EXPECT_EQ(clean.mesh.triangles, mesh.triangles);
    EXPECT_EQ(clean.counts, remesh::CleanCounts{});
    EXPECT_TRUE(clean.welded_positions.empty());
}

// The reach of most vertices is 5e-6 here, that of the fine part 2.5e-7 with a gap of 1e-7: it
// would be welded alone.
TEST(Places, FinePartsOfCoarseMeshesAreNotWelded) {
    TriangleMesh fine = with_size(grids_with_gap(4, 1e-3), 1);
    EXPECT_EQ(num_components(remesh::clean_input(fine.view())), 2u);
    fine = grids_with_gap(4, 1e-3);
    for (Vec3& p : fine.positions) p = p / 10'000 + Vec3(0, 0, 5);
    const TriangleMesh mesh = shapes::join(fine, shapes::grid(20));
    EXPECT_EQ(num_components(remesh::clean_input(mesh.view())), 3u);
}

TEST(Places, SitesInMovedFacesAreCarried) {
    const TriangleMesh soup = shapes::jitter(shapes::unweld(shapes::torus(12, 9)), 1e-8, 5);
    const CleanResult clean = remesh::clean_input(soup.view());
    ASSERT_FALSE(clean.welded_positions.empty());
    std::vector<agvd::SurfacePoint> sites;
    for (Index f = 0; f < soup.triangles.size(); f += 7) {
        sites.push_back({agvd::FaceId(f), {0.5, 0.3, 0.2}});
    }
    const auto carried = remesh::to_cleaned(sites, soup.view(), clean);
    EXPECT_EQ(remesh::to_original(carried, soup.view(), clean), sites);
    for (std::size_t i = 0; i < sites.size(); ++i) {
        EXPECT_EQ(carried[i].barycentric, sites[i].barycentric) << i;
    }
}
