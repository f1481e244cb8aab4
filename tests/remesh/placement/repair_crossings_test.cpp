// Faces that intersect are parted, and the count and the topology stay.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "agvd/mesh/topology.h"
#include "remesh/placement/crossing_guard.h"
#include "remesh/placement/placement.h"
#include "support/movable_mesh.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// Two walls of a bent sheet, 1 / 20 of a radius apart, with faces so long that their chords meet.
struct Walls {
    Walls() : placed(make()) {
        // A vertex of the inner wall is put through the outer one.
        Index inner = 0;
        for (Index v = 0; v < placed.placed.points.size(); ++v) {
            const Vec3 at = placed.placed.position(placed.surface.mesh.view(), v);
            if (at.norm() < 0.97 && at.z() > 0.9) inner = v;
        }
        pushed = inner;
        const Vec3 at = placed.placed.position(placed.surface.mesh.view(), inner);
        placed.placed.offsets[inner] = 0.12 * at;
    }
    static TriangleMesh make() {
        TriangleMesh inner = shapes::sphere(3);
        for (Vec3& p : inner.positions) p *= 0.95;
        for (Triangle& t : inner.triangles) std::swap(t[1], t[2]);
        return shapes::join(shapes::sphere(3), inner);
    }
    // Pairs of faces that intersect.
    [[nodiscard]] std::vector<std::pair<Index, Index>> pairs() {
        const remesh::detail::MeshCurves curves = placed.curves();
        const remesh::detail::EditedMesh edited(curves, placed.placed, placed.mobility);
        const remesh::detail::CrossingGuard guard(edited);
        std::vector<std::pair<Index, Index>> found;
        for (Index f = 0; f < edited.num_faces(); ++f) {
            const Index g = guard.face_through(f);
            if (g != no_index && f < g) found.emplace_back(f, g);
        }
        return found;
    }

    MovableMesh placed;
    Index pushed = 0;
};

}  // namespace

TEST(RepairCrossings, FacesArePartedAndTheCountAndTheTopologyStay) {
    Walls walls;
    const TriangleMesh before = walls.placed.mesh_of(walls.placed.placed);
    const auto pairs = walls.pairs();
    ASSERT_GE(pairs.size(), 3u);
    const std::vector<Index> numbers =
        repair_crossings(walls.placed.curves(), walls.placed.mobility, pairs, walls.placed.placed);
    ASSERT_EQ(numbers.size(), before.positions.size());
    const TriangleMesh after = walls.placed.mesh_of(walls.placed.placed);
    walls.placed.mobility.resize(after.positions.size());
    EXPECT_TRUE(walls.pairs().empty());
    const remesh::Topology topology = remesh::analyze_topology(after.view());
    EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
    EXPECT_TRUE(same_topology(topology, remesh::analyze_topology(before.view())));
}

TEST(RepairCrossings, AMeshWithoutPairsStaysAsItIs) {
    MovableMesh placed(shapes::sphere(3));
    const std::vector<Triangle> before = placed.placed.triangles;
    EXPECT_TRUE(repair_crossings(placed.curves(), placed.mobility, {}, placed.placed).empty());
    EXPECT_EQ(placed.placed.triangles, before);
}

// The corners of a face beside an edge are put so that it nearly lies on the face beyond.
TEST(RepairCrossings, TheGuardKnowsFolds) {
    for (const double degrees : {0.9, 1.1}) {
        const double z = std::tan(degrees * std::numbers::pi / 180);
        const TriangleMesh folded{{{0, -1, 0}, {0, 1, 0}, {2, 0, 0}, {1, 0, z}},
                                  {{0, 2, 1}, {0, 1, 3}}};
        MovableMesh placed(folded);
        const remesh::detail::MeshCurves curves = placed.curves();
        const remesh::detail::EditedMesh edited(curves, placed.placed, placed.mobility);
        const remesh::detail::CrossingGuard guard(edited);
        EXPECT_EQ(guard.face_through(0), degrees < 1 ? 1 : no_index) << degrees;
    }
}
