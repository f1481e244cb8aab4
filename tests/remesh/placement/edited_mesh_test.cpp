// Steps on a mesh keep it a manifold, and can be taken back.
#include "remesh/placement/edited_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "agvd/mesh/topology.h"
#include "remesh/curves/curve_network.h"
#include "remesh/placement/mesh_curves.h"
#include "support/flag_edges.h"
#include "support/movable_mesh.h"
#include "support/parts.h"
#include "support/shapes.h"

using namespace agvd;
using remesh::PlacedMesh;
using remesh::detail::EditedMesh;
using remesh::detail::Mobility;

namespace {

struct Sample : MovableMesh {
    explicit Sample(const TriangleMesh& mesh) : MovableMesh(mesh) {}

    [[nodiscard]] EditedMesh edited() const { return {curves_, placed, mobility}; }

    [[nodiscard]] TriangleMesh result(const EditedMesh& edited) const {
        std::vector<Index> numbers;
        return mesh_of(edited.result(numbers));
    }

private:
    remesh::detail::MeshCurves curves_ = curves();
};

bool is_like(const TriangleMesh& mesh, const TriangleMesh& other) {
    const remesh::Topology a = remesh::analyze_topology(mesh.view());
    return a.is_manifold && a.is_oriented &&
           same_topology(a, remesh::analyze_topology(other.view()));
}

TEST(EditedMesh, AFlipTakesTheOtherDiagonalOnce) {
    const TriangleMesh mesh = shapes::sphere(2);
    const Sample sample(mesh);
    EditedMesh edited = sample.edited();
    const Triangle before = edited.face(0).corner;
    ASSERT_TRUE(edited.flip(0, 0));
    EXPECT_NE(edited.face(0).corner, before);
    const TriangleMesh flipped = sample.result(edited);
    EXPECT_EQ(flipped.positions.size(), mesh.positions.size());
    EXPECT_EQ(flipped.triangles.size(), mesh.triangles.size());
    EXPECT_TRUE(is_like(flipped, mesh));
}

// The normal of a sliver tells nothing: without a bound collapses make slivers of 18 mean lengths.
TEST(EditedMesh, CollapsesMakeNoLongSlivers) {
    TriangleMesh strip = shapes::grid(12);
    for (Vec3& p : strip.positions) p.y() *= 0.02;
    const Sample sample(strip);
    EditedMesh edited = sample.edited();
    int num_collapses = 0;
    for (bool is_changed = true; is_changed;) {
        is_changed = false;
        for (const Index f : edited.faces()) {
            for (Index k = 0; k < 3 && edited.face(f).is_there; ++k) {
                const Triangle& t = edited.face(f).corner;
                const Index gone = t[k], into = t[(k + 1) % 3];
                // Along the rows, which stay thin.
                if (edited.at(gone).y() != edited.at(into).y()) continue;
                if (!edited.collapse(gone, into)) continue;
                is_changed = true;
                ++num_collapses;
            }
        }
    }
    EXPECT_GT(num_collapses, 0);
    double longest = 0;
    for (const Index f : edited.faces()) {
        longest = std::max(longest, remesh::detail::longest_edge_of(edited.corners_of(f)));
    }
    EXPECT_LE(longest, 2 * edited.mean_length());
}

TEST(EditedMesh, AVertexWhoseWalkIsCutOffStays) {
    const TriangleMesh mesh = shapes::sphere(0);
    const Sample sample(mesh);
    EditedMesh edited = sample.edited();
    const Vec3 way = mesh.positions[mesh.triangles[0][1]] - mesh.positions[0];
    EXPECT_FALSE(edited.move(0, 1e5 * way, -2));
    EXPECT_EQ(edited.num_crossings(), 2000u);
    EXPECT_TRUE(edited.move(0, 1e-4 * way, -2));
    EXPECT_EQ(edited.num_crossings(), 2000u);
    (void)edited.move(0, 1.5 * way, -2);
    EXPECT_EQ(edited.num_crossings(), 2002u);
}

// A loss of quality is allowed here: it is the normals that end the moves.
TEST(EditedMesh, MovesTurnNoNormalFar) {
    const Sample sample(shapes::sphere(1));
    EditedMesh edited = sample.edited();
    const auto normals_at = [&](Index v) {
        std::vector<Vec3> normals;
        for (const Index f : edited.faces_at(v)) {
            const auto& [a, b, c] = edited.face(f).corner;
            normals.push_back(
                (edited.at(b) - edited.at(a)).cross(edited.at(c) - edited.at(a)).normalized());
        }
        return normals;
    };
    Index num_moved = 0, num_stayed = 0;
    for (Index v = 0; v < edited.num_vertices(); ++v) {
        const Triangle corner = edited.face(edited.faces_at(v)[0]).corner;
        const Vec3 way = edited.at(corner[corner[0] == v ? 1 : 0]) - edited.at(v);
        for (const double share : {0.2, 0.6, 0.9, 1.1, 2.}) {
            const EditedMesh::Mark mark = edited.mark();
            const std::vector<Vec3> before = normals_at(v);
            if (edited.move(v, share * way, -2)) {
                ++num_moved;
                const std::vector<Vec3> after = normals_at(v);
                for (std::size_t i = 0; i < before.size(); ++i) {
                    EXPECT_GT(before[i].dot(after[i]), 0.5);
                }
            } else {
                ++num_stayed;
            }
            edited.take_back(mark);
        }
    }
    EXPECT_GT(num_moved, 40u);
    EXPECT_GT(num_stayed, 40u);
}

TEST(EditedMesh, HardEdgesAreNotFlipped) {
    const TriangleMesh mesh = shapes::sphere(1);
    Sample sample(mesh);
    const Triangle t = mesh.triangles[0];
    sample.placed.hard = {{t[1], t[0]}};
    sample.mobility[t[0]] = sample.mobility[t[1]] = Mobility::Fixed;
    EditedMesh edited = sample.edited();
    EXPECT_FALSE(edited.flip(0, 0));
    EXPECT_TRUE(edited.flip(0, 1));
}

TEST(EditedMesh, ASplitAddsAVertexAndACollapseTakesItAway) {
    const TriangleMesh mesh = shapes::sphere(2);
    const Sample sample(mesh);
    EditedMesh edited = sample.edited();
    const Index a = edited.face(5).corner[1], b = edited.face(5).corner[2];
    const Index added = edited.split(5, 1);
    ASSERT_NE(added, no_index);
    EXPECT_LT((edited.at(added) - (edited.at(a) + edited.at(b)) / 2).norm(),
              0.1 * (edited.at(a) - edited.at(b)).norm());
    EXPECT_EQ(edited.faces_at(added).size(), 4u);
    EXPECT_EQ(sample.result(edited).triangles.size(), mesh.triangles.size() + 2);
    EXPECT_TRUE(is_like(sample.result(edited), mesh));
    ASSERT_TRUE(edited.collapse(added, a));
    EXPECT_TRUE(edited.faces_at(added).empty());
    EXPECT_EQ(sample.result(edited).positions, mesh.positions);
    EXPECT_TRUE(is_like(sample.result(edited), mesh));
}

TEST(EditedMesh, ASplitIsWhereItIsAskedForButNotAtTheEnds) {
    const Sample sample(shapes::sphere(2));
    for (const auto& [asked, wanted] : {std::pair(0.3, 0.3), {0.05, 0.2}, {1.2, 0.8}}) {
        EditedMesh edited = sample.edited();
        const Index added = edited.split(5, 1, asked);
        ASSERT_NE(added, no_index) << asked;
        const Vec3 from = edited.at(sample.placed.triangles[5][1]);
        const Vec3 to = edited.at(sample.placed.triangles[5][2]);
        const double share = (edited.at(added) - from).dot(to - from) / (to - from).squaredNorm();
        EXPECT_NEAR(share, wanted, 0.02);
    }
}

// A collapse next to the boundary makes an inner edge one of the boundary.
TEST(EditedMesh, AnyCollapsesKeepTheBoundaryHard) {
    const TriangleMesh mesh = shapes::tube(24, 6);
    const Sample sample(mesh);
    EditedMesh edited = sample.edited();
    for (Index v = 0; v < mesh.positions.size(); v += 2) {
        if (edited.faces_at(v).empty()) continue;
        for (const Index into : edited.face(edited.faces_at(v)[0]).corner) {
            if (into != v && edited.collapse(v, into)) break;
        }
    }
    const TriangleMesh result = sample.result(edited);
    EXPECT_LT(result.positions.size(), mesh.positions.size());
    EXPECT_TRUE(is_like(result, mesh));
    std::size_t num_hard = 0;
    for (Index f = 0; f < edited.num_faces(); ++f) {
        if (!edited.face(f).is_there) continue;
        for (std::size_t k = 0; k < 3; ++k) num_hard += edited.face(f).is_hard(k) ? 1 : 0;
    }
    EXPECT_EQ(num_hard, remesh::rim_of(result.triangles).size());
}

TEST(EditedMesh, TheLastTriangleStays) {
    const Sample sample(TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    EditedMesh edited = sample.edited();
    for (const Index gone : {0U, 1U, 2U}) EXPECT_FALSE(edited.collapse(gone, (gone + 1) % 3));
    EXPECT_EQ(sample.result(edited).triangles.size(), 1u);
}

TEST(EditedMesh, VerticesOnTheBoundaryMoveAlongItOnly) {
    const TriangleMesh mesh = shapes::tube(24, 6);
    const Sample sample(mesh);
    EditedMesh edited = sample.edited();
    const Index v = sample.placed.hard[0].first;
    const Vec3 before = edited.at(v);
    ASSERT_TRUE(edited.move(v, {0.01, 0.02, 0.3}, -1));
    EXPECT_NE(edited.at(v), before);
    EXPECT_DOUBLE_EQ(edited.at(v).z(), before.z());
    Sample fixed = sample;
    fixed.mobility[v] = Mobility::Fixed;
    EditedMesh other = fixed.edited();
    EXPECT_FALSE(other.move(v, {0.01, 0.02, 0.3}, -1));
}

TEST(EditedMesh, StepsAreTakenBackToTheLastBit) {
    const TriangleMesh mesh = shapes::jitter(shapes::tube(24, 8), 0.01, 3);
    const Sample sample(mesh);
    EditedMesh edited = sample.edited();
    ASSERT_TRUE(edited.move(60, {0.01, 0, 0.01}, -1));
    const PlacedMesh first = [&] {
        std::vector<Index> numbers;
        return edited.result(numbers);
    }();
    const EditedMesh::Mark mark = edited.mark();
    int num_steps = 0;
    for (Index f = 0; f < mesh.triangles.size(); f += 3) {
        if (!edited.face(f).is_there) continue;
        const Triangle t = edited.face(f).corner;
        num_steps += edited.flip(f, f % 3) ? 1 : 0;
        num_steps += edited.move(t[0], {0.01, 0.01, 0.02}, -1) ? 1 : 0;
        num_steps += edited.split(f, (f + 1) % 3) != no_index ? 1 : 0;
        num_steps += edited.collapse(t[1], t[2]) ? 1 : 0;
    }
    EXPECT_GT(num_steps, 100);
    std::vector<Index> now;
    std::vector<double> before;
    edited.changed_since(mark, now, before);
    EXPECT_FALSE(now.empty());
    EXPECT_LE(before.size(), mesh.triangles.size());
    edited.take_back(mark);
    edited.changed_since(mark, now, before);
    EXPECT_TRUE(now.empty());
    std::vector<Index> numbers;
    const PlacedMesh last = edited.result(numbers);
    EXPECT_EQ(last.triangles, first.triangles);
    EXPECT_EQ(sample.mesh_of(last).positions, sample.mesh_of(first).positions);
    for (Index v = 0; v < edited.num_vertices(); ++v) {
        for (const Index f : edited.faces_at(v)) {
            const Triangle& t = edited.face(f).corner;
            EXPECT_NE(std::find(t.begin(), t.end(), v), t.end());
        }
    }
}

// The mesh of a box on the box itself, cut along its twelve edges.
struct CreasedBox {
    CreasedBox()
        : whole(build_surface(parts::box({1, 1, 1}, 4).view())),
          network(remesh::find_network(whole, flag_sharp_edges(whole), 0.1)),
          cut(remesh::cut_surface(whole, flag_sharp_edges(whole))),
          curves(whole, cut.surface(), network) {
        placed.triangles = whole.mesh.triangles;
        placed.points.resize(whole.num_vertices());
        placed.offsets.assign(whole.num_vertices(), Vec3::Zero());
        for (Index h = 0; h < whole.twin.size(); ++h) {
            SurfacePoint corner{FaceId(h / 3), {0, 0, 0}};
            corner.barycentric[h % 3] = 1;
            placed.points[whole.tail(h)] = corner;
        }
        for (const SurfacePoint& point : placed.points) {
            const remesh::detail::CurvePlace place = curves.place_of(point);
            mobility.push_back(place.is_free()           ? Mobility::Free
                               : place.curve != no_index ? Mobility::Boundary
                                                         : Mobility::Fixed);
        }
        const std::vector<std::uint8_t> is_crease = flag_sharp_edges(whole);
        for (Index e = 0; e < whole.num_edges(); ++e) {
            const Index h = whole.edge_half[e];
            if (is_crease[e] != 0) placed.hard.emplace_back(whole.tail(h), whole.head(h));
        }
    }
    // How many coordinates of a point are those of a side.
    [[nodiscard]] static int num_sides(const Vec3& p) {
        return static_cast<int>(std::count_if(
            p.begin(), p.end(), [](double x) { return std::abs(x - std::round(x)) < 1e-12; }));
    }

    Surface whole;
    remesh::CurveNetwork network;
    remesh::CutSurface cut;
    remesh::detail::MeshCurves curves;
    PlacedMesh placed;
    std::vector<Mobility> mobility;
};

TEST(EditedMesh, VerticesOnCreasesSlideAlongThem) {
    const CreasedBox box;
    EditedMesh edited(box.curves, box.placed, box.mobility);
    int num_on_creases = 0, num_corners = 0;
    for (Index v = 0; v < edited.num_vertices(); ++v) {
        const Vec3 before = edited.at(v);
        const bool moves = edited.move(v, {0.03, 0.04, 0.05}, -1);
        const int sides = CreasedBox::num_sides(before);
        if (sides == 3) {
            ++num_corners;
            EXPECT_EQ(edited.mobility(v), Mobility::Fixed);
            EXPECT_FALSE(moves);
        }
        if (sides != 2) continue;
        ++num_on_creases;
        EXPECT_TRUE(moves);
        EXPECT_EQ(CreasedBox::num_sides(edited.at(v)), 2);
        // Along the crease alone, by the step's component there.
        const double way = (edited.at(v) - before).norm();
        EXPECT_TRUE(std::abs(way - 0.03) < 1e-9 || std::abs(way - 0.04) < 1e-9 ||
                    std::abs(way - 0.05) < 1e-9);
        EXPECT_FALSE(edited.move(v, {2, 2, 2}, -2));  // Past the corner.
    }
    EXPECT_EQ(num_corners, 8);
    EXPECT_EQ(num_on_creases, 12 * 3);
}

TEST(EditedMesh, CreasesAreSplitAndCollapsedAlongThemselves) {
    const CreasedBox box;
    EditedMesh edited(box.curves, box.placed, box.mobility);
    int num_tried = 0;
    for (Index f = 0; f < box.placed.triangles.size(); ++f) {
        for (Index k = 0; k < 3; ++k) {
            if (!edited.face(f).is_hard(k)) continue;
            const Triangle t = edited.face(f).corner;
            const Index a = t[k], b = t[(k + 1) % 3];
            EXPECT_FALSE(edited.flip(f, k));
            const EditedMesh::Mark mark = edited.mark();
            const Index added = edited.split(f, k);
            // Between two corners there are three vertices: one end at least may move.
            ASSERT_NE(added, no_index);
            EXPECT_LT((edited.at(added) - (edited.at(a) + edited.at(b)) / 2).norm(), 1e-12);
            EXPECT_EQ(edited.faces_at(added).size(), 4u);
            EXPECT_EQ(edited.mobility(added), Mobility::Boundary);
            const auto neighbours = edited.hard_neighbours(added);
            EXPECT_EQ(std::minmax(neighbours[0], neighbours[1]), std::minmax(a, b));
            EXPECT_TRUE(edited.collapse(added, a));
            EXPECT_EQ(edited.faces_at(added).size(), 0u);
            edited.take_back(mark);
            // Not off the crease.
            const Index c = t[(k + 2) % 3];
            if (edited.mobility(c) == Mobility::Free) {
                EXPECT_FALSE(edited.collapse(a, c));
            }
            ++num_tried;
        }
    }
    EXPECT_EQ(num_tried, 2 * 12 * 4);
}

}  // namespace
