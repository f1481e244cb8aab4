// Any sequence of allowed edits keeps the topology and can be taken back.
#include "remesh/dual/fan_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "agvd/mesh/topology.h"
#include "support/dice.h"
#include "support/shapes.h"

using namespace agvd;
using remesh::detail::FanMesh;

namespace {

FanMesh fans_of(const TriangleMesh& mesh) {
    return {mesh.triangles, static_cast<Index>(mesh.positions.size())};
}

// Of the vertices that are left; the topology needs no positions.
remesh::Topology topology_of(const FanMesh& mesh) {
    std::vector<Triangle> triangles = mesh.triangles();
    std::map<Index, Index> number;
    for (Triangle& t : triangles) {
        for (Index& v : t)
            v = number.try_emplace(v, static_cast<Index>(number.size())).first->second;
    }
    const std::vector<Vec3> positions(number.size(), Vec3::Zero());
    return remesh::analyze_topology({positions, triangles});
}

void expect_fans_fit(const FanMesh& mesh) {
    std::size_t num_corners = 0;
    for (Index v = 0; v < mesh.num_vertices(); ++v) {
        const std::span<const Index> fan = mesh.faces_at(v);
        num_corners += fan.size();
        EXPECT_EQ(std::set<Index>(fan.begin(), fan.end()).size(), fan.size());
        for (const Index f : fan) EXPECT_TRUE(mesh.face(f).is_there && mesh.has_corner(f, v));
    }
    EXPECT_EQ(num_corners, 3 * mesh.triangles().size());
}

// Takes the edit of the half-edge that a number stands for, if it is allowed.
bool edit(FanMesh& mesh, Index h, int kind) {
    if (!mesh.face(h / 3).is_there) return false;
    if (kind == 0 && mesh.can_flip(h)) return mesh.flip(h), true;
    if (kind == 1) return mesh.split(h), true;
    if (kind == 2 && mesh.can_collapse(mesh.tail(h), mesh.head(h))) {
        return mesh.collapse(mesh.tail(h), mesh.head(h)), true;
    }
    return false;
}

// Each edge by its number, on both sides.
void number_edges(FanMesh& mesh) {
    for (Index h = 0, count = 0; h < 3 * mesh.num_faces(); ++h) {
        if (mesh.is_hard(h)) continue;
        const Index other = mesh.twin(h);
        mesh.put_label(h, count);
        if (other != no_index) mesh.put_label(other, count);
        ++count;
    }
}

TEST(FanMesh, EditsKeepTheTopologyAndCanBeTakenBack) {
    const std::vector<std::vector<int>> mixes{{0}, {0, 1, 2}, {0, 2, 2, 2}, {2}};
    for (const TriangleMesh& shape : {shapes::sphere(2), shapes::torus(12, 8), shapes::tube(9, 4),
                                      shapes::grid(6), shapes::icosahedron()}) {
        for (const std::vector<int>& kinds : mixes) {
            FanMesh mesh = fans_of(shape);
            number_edges(mesh);
            const remesh::Topology before = topology_of(mesh);
            const FanMesh::Mark mark = mesh.mark();
            Dice dice(7);
            int num_edits = 0;
            for (int i = 0; i < 1500; ++i) {
                const Index h = dice.count(0, 3 * mesh.num_faces() - 1);
                const int kind = kinds[static_cast<std::size_t>(i) % kinds.size()];
                num_edits += edit(mesh, h, kind) ? 1 : 0;
            }
            EXPECT_GT(num_edits, 5);
            const remesh::Topology after = topology_of(mesh);
            EXPECT_TRUE(after.is_manifold && after.is_oriented && same_topology(before, after));
            expect_fans_fit(mesh);
            for (Index h = 0; h < 3 * mesh.num_faces(); ++h) {
                if (!mesh.face(h / 3).is_there) continue;
                const Index other = mesh.twin(h);
                if (other == no_index) {
                    EXPECT_TRUE(mesh.is_on_rim(mesh.tail(h)));
                } else {
                    EXPECT_EQ(mesh.label(h), mesh.label(other));
                }
            }
            mesh.take_back(mark);
            EXPECT_EQ(mesh.triangles(), shape.triangles);
            EXPECT_TRUE(mesh.changed_since(mark).empty());
            expect_fans_fit(mesh);
        }
    }
}

TEST(FanMesh, AFlipNeedsAnInnerEdgeAndANewOne) {
    const std::vector<Triangle> quad{{0, 1, 2}, {1, 0, 3}};
    FanMesh open(quad, 4);
    number_edges(open);
    const Index label = open.label(open.half_edge(2, 0));
    EXPECT_FALSE(open.can_flip(open.half_edge(1, 2)));
    ASSERT_TRUE(open.can_flip(0));
    open.flip(0);
    EXPECT_EQ(open.half_edge(0, 1), no_index);
    EXPECT_NE(open.twin(open.half_edge(2, 3)), no_index);
    EXPECT_EQ(open.label(open.half_edge(2, 0)), label);
    EXPECT_FALSE(open.is_hard(open.half_edge(2, 3)));
    // Closed below by two faces that have the edge from 2 to 3.
    EXPECT_FALSE(
        FanMesh(std::vector<Triangle>{{0, 1, 2}, {1, 0, 3}, {0, 2, 3}, {2, 1, 3}}, 4).can_flip(0));
    EXPECT_FALSE(FanMesh(std::vector<Triangle>{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, 5).can_flip(0));
    EXPECT_FALSE(FanMesh(std::vector<Triangle>{{0, 1, 2}, {0, 1, 3}}, 4).can_flip(0));
}

TEST(FanMesh, ACollapseNeedsTheLinkCondition) {
    const FanMesh tetrahedron(std::vector<Triangle>{{0, 1, 2}, {1, 0, 3}, {0, 2, 3}, {2, 1, 3}}, 4);
    EXPECT_FALSE(tetrahedron.can_collapse(0, 1));
    const FanMesh single(std::vector<Triangle>{{0, 1, 2}}, 3);
    EXPECT_FALSE(single.can_collapse(0, 1));
    const FanMesh strip(std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}}, 4);
    EXPECT_TRUE(strip.can_collapse(0, 1));
    EXPECT_FALSE(strip.can_collapse(1, 2)) << "both on the rim, the edge inside";
    EXPECT_FALSE(strip.can_collapse(0, 3)) << "no edge";
    // A tetrahedron with a vertex on one side: around that side are three edges and no face.
    const FanMesh pierced(
        std::vector<Triangle>{{0, 1, 4}, {1, 2, 4}, {2, 0, 4}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}}, 5);
    EXPECT_FALSE(pierced.can_collapse(0, 1));
    EXPECT_TRUE(pierced.can_collapse(4, 0));
}

// In a fan around 0 the collapse of 0 into 1 removes faces (0, 1, 2) and (0, 4, 1).
TEST(FanMesh, ACollapseKeepsLabelsOfBothSides) {
    const std::vector<Triangle> ring{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1},
                                     {1, 5, 2}, {2, 5, 3}, {3, 5, 4}, {4, 5, 1}};
    const auto label_both = [](FanMesh& mesh, Index a, Index b, Index label) {
        mesh.put_label(mesh.half_edge(a, b), label);
        mesh.put_label(mesh.half_edge(b, a), label);
    };
    FanMesh mesh(ring, 6);
    label_both(mesh, 0, 2, 7);  // Only this of two sides: kept.
    label_both(mesh, 0, 4, 8);
    label_both(mesh, 1, 4, 9);  // At the vertex that stays: first.
    ASSERT_TRUE(mesh.can_collapse(0, 1));
    mesh.collapse(0, 1);
    for (const auto& [a, b] : {std::pair<Index, Index>{1, 2}, {2, 1}}) {
        EXPECT_EQ(mesh.label(mesh.half_edge(a, b)), 7u);
    }
    for (const auto& [a, b] : {std::pair<Index, Index>{1, 4}, {4, 1}}) {
        EXPECT_EQ(mesh.label(mesh.half_edge(a, b)), 9u);
    }
}

}  // namespace
