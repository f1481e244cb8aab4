// Which of creases side by side a mesh of a spacing keeps.
#include "remesh/curves/select_creases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "agvd/mesh/surface_points.h"
#include "support/flag_edges.h"
#include "support/parts.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Surface;
using agvd::TriangleMesh;
using agvd::Vec3;

namespace {

struct Creases {
    explicit Creases(const TriangleMesh& mesh)
        : surface(agvd::build_surface(mesh.view())), all(flag_sharp_edges(surface)) {}

    [[nodiscard]] std::vector<std::uint8_t> select(
        double spacing, const std::vector<std::uint8_t>& is_fixed = {}) const {
        std::vector<std::uint8_t> left = all;
        remesh::select_creases(surface, spacing, {}, 0, is_fixed, 1, {}, left);
        return left;
    }
    // The length of the marked edges whose ends are all like that.
    template <typename IsLike>
    [[nodiscard]] double length(const std::vector<std::uint8_t>& marks,
                                const IsLike& is_like) const {
        double sum = 0;
        for (Index e = 0; e < surface.num_edges(); ++e) {
            const Index h = surface.edge_half[e];
            const auto& p = surface.mesh.positions;
            if (marks[e] != 0 && is_like(p[surface.tail(h)]) && is_like(p[surface.head(h)])) {
                sum += surface.length[e];
            }
        }
        return sum;
    }
    [[nodiscard]] double length(const std::vector<std::uint8_t>& marks) const {
        return length(marks, [](const Vec3&) { return true; });
    }

    Surface surface;
    std::vector<std::uint8_t> all;
};

// An angle of sheet metal: two arms of length 4 and thickness t along x and y, extruded along z.
TriangleMesh sheet_angle(double t, int steps) {
    const std::vector<Vec3> profile{{0, 0, 0}, {4, 0, 0}, {4, t, 0},
                                    {t, t, 0}, {t, 4, 0}, {0, 4, 0}};
    const std::vector<agvd::Triangle> cap{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
    TriangleMesh mesh;
    const auto n = static_cast<Index>(profile.size());
    for (int i = 0; i <= steps; ++i) {
        for (const Vec3& p : profile) mesh.positions.push_back(p + Vec3(0, 0, 4. * i / steps));
    }
    for (const auto& [a, b, c] : cap) {
        mesh.triangles.push_back({a, c, b});
        const Index top = n * static_cast<Index>(steps);
        mesh.triangles.push_back({a + top, b + top, c + top});
    }
    for (Index i = 0; i < static_cast<Index>(steps); ++i) {
        for (Index k = 0; k < n; ++k) {
            const Index a = n * i + k, b = n * i + (k + 1) % n;
            mesh.triangles.push_back({a, b, b + n});
            mesh.triangles.push_back({a, b + n, a + n});
        }
    }
    return mesh;
}

// What stays of the two rims of a plate of this thickness, and the strip between them.
struct Rims {
    Rims(double thickness, double spacing, double num_sites)
        : plate(parts::box({4, 3, thickness}, 6)), left(plate.all) {
        strips = remesh::select_creases(plate.surface, spacing, {}, num_sites, {}, 1, {}, left);
    }

    Creases plate;
    std::vector<std::uint8_t> left;
    std::vector<remesh::SizedPoint> strips;
};

}  // namespace

TEST(SelectCreases, ThoseFarFromEachOtherStay) {
    const Creases box(parts::box({1, 1, 1}, 4));
    EXPECT_EQ(box.select(0.3), box.all);
    EXPECT_NEAR(box.length(box.all), 12, 1e-12);
    // Edges of one face that meet are close at their corners.
    EXPECT_EQ(box.select(0.9), box.all);
}

TEST(SelectCreases, OfTheRimsOfAThinPlateOneStaysAsAWhole) {
    const Creases plate(parts::box({4, 3, 0.05}, 6));
    const std::vector<std::uint8_t> left = plate.select(0.3);
    EXPECT_NEAR(plate.length(left), 14, 1e-12);
    const double low = plate.length(left, [](const Vec3& p) { return p.z() < 0.01; });
    EXPECT_NEAR(std::max(low, 14 - low), 14, 1e-12);
    // With a spacing of twice the thickness both stay, and the short edges between them too.
    EXPECT_EQ(plate.select(0.1), plate.all);
}

TEST(SelectCreases, RimsAreCloseByTheLengthsThere) {
    const Creases plate(parts::box({4, 3, 0.05}, 8));
    const double spacing = 0.3, even = std::sqrt(2 / std::sqrt(3));
    const auto left_with = [&](double near, double far) {
        std::vector<std::uint8_t> left = plate.all;
        const auto length_at = [&](const agvd::SurfacePoint& point) {
            const double x = agvd::position(plate.surface.mesh.view(), point).x();
            return even * spacing * (x < 2 ? near : far);
        };
        remesh::select_creases(plate.surface, spacing, length_at, 0, {}, 1, {}, left);
        return left;
    };
    EXPECT_EQ(left_with(1, 1), plate.select(spacing));
    // Where edges are to be longer strips make them shorter.
    EXPECT_EQ(left_with(1, 3), plate.select(spacing));
    EXPECT_EQ(left_with(1. / 3, 1. / 3), plate.all);
    // The second rim stays on one half, and on the other goes with the edges at the corners.
    const std::vector<std::uint8_t> left = left_with(1, 1. / 3);
    const auto is_far = [](const Vec3& p) { return p.x() > 2.1; };
    EXPECT_EQ(plate.length(left, is_far), plate.length(plate.all, is_far));
    const auto is_near = [](const Vec3& p) { return p.x() < 1.9; };
    EXPECT_NEAR(plate.length(left, is_near), 6, 1e-12);
}

// What the curved part costs, which strips are weighed against, is that of the surface.
TEST(SelectCreases, FlatFacesThatAreDividedChangeNothing) {
    const TriangleMesh mesh = shapes::join(parts::box({4, 3, 0.05}, 8), shapes::torus(40, 20, 0.8));
    const Creases whole(mesh), divided(shapes::subdivide(mesh));
    EXPECT_NEAR(whole.length(whole.all), 28.2, 1e-12);
    int num_strips = 0, num_tried = 0;
    for (double spacing = 0.16; spacing < 0.34; spacing += 0.01, ++num_tried) {
        const auto left_of = [&](const Creases& creases) {
            std::vector<std::uint8_t> left = creases.all;
            remesh::select_creases(creases.surface, spacing, {}, 1500, {}, 1, {}, left);
            return creases.length(left);
        };
        const double left = left_of(whole);
        EXPECT_NEAR(left_of(divided), left, 0.1) << spacing;
        if (left > 20) ++num_strips;
    }
    EXPECT_GT(num_strips, 1);
    EXPECT_LT(num_strips, num_tried - 1);
}

// The long sides of one rim and the short sides of the other are the longest.
TEST(SelectCreases, ARimIsNotPutTogetherFromTwo) {
    TriangleMesh mesh = parts::box({4, 3, 0.05}, 6);
    for (Vec3& p : mesh.positions) (p.z() > 0.025 ? p.x() : p.y()) *= 1.01;
    const Creases plate(mesh);
    const std::vector<std::uint8_t> left = plate.select(0.3);
    EXPECT_NEAR(plate.length(left), 2 * (4.04 + 3), 1e-9);
    EXPECT_NEAR(plate.length(left, [](const Vec3& p) { return p.z() > 0.04; }), 2 * (4.04 + 3),
                1e-9);
}

TEST(SelectCreases, OnBothSidesOfAThinWallTheyStay) {
    const double t = 0.05;
    const Creases angle(sheet_angle(t, 12));
    const std::vector<std::uint8_t> left = angle.select(0.4);
    const auto is_at = [](double x, double y) {
        return [x, y](const Vec3& p) { return p.x() == x && p.y() == y; };
    };
    EXPECT_NEAR(angle.length(left, is_at(0, 0)), 4, 1e-12);
    // Its ends are close to the outlines of the two caps.
    EXPECT_GE(angle.length(left, is_at(t, t)), 3);
    // At the ends of the arms one edge of two stays.
    EXPECT_NEAR(angle.length(left, is_at(4, 0)) + angle.length(left, is_at(4, t)), 4, 1e-12);
    EXPECT_NEAR(angle.length(left, is_at(0, 4)) + angle.length(left, is_at(t, 4)), 4, 1e-12);
}

TEST(SelectCreases, FixedOnesStay) {
    const Creases plate(parts::box({4, 3, 0.05}, 6));
    EXPECT_EQ(plate.select(0.3, plate.all), plate.all);
    // The other rim gives way to a fixed one.
    const std::vector<std::uint8_t> first = plate.select(0.3);
    std::vector<std::uint8_t> other = plate.all;
    const bool is_low = plate.length(first, [](const Vec3& p) { return p.z() < 0.01; }) > 7;
    for (Index e = 0; e < other.size(); ++e) {
        const Index h = plate.surface.edge_half[e];
        for (const Index v : {plate.surface.tail(h), plate.surface.head(h)}) {
            const double z = plate.surface.mesh.positions[v].z();
            if (is_low ? z < 0.049 : z > 0.001) other[e] = 0;
        }
    }
    EXPECT_NEAR(plate.length(other), 14, 1e-12);
    EXPECT_EQ(plate.select(0.3, other), other);
}

// The caller may mark edges of the boundary, in any direction.
TEST(SelectCreases, MarkedEdgesOfTheBoundaryStay) {
    Creases grid(shapes::grid(8));
    Index num_marked = 0;
    for (Index e = 0; e < grid.all.size(); ++e) {
        grid.all[e] = grid.surface.twin[grid.surface.edge_half[e]] == agvd::no_index ? 1 : 0;
        num_marked += grid.all[e];
    }
    EXPECT_EQ(num_marked, 32u);
    // And a line across, along the middle.
    for (Index e = 0; e < grid.all.size(); ++e) {
        const Index h = grid.surface.edge_half[e];
        const double x = grid.surface.mesh.positions[grid.surface.tail(h)].x();
        if (x == grid.surface.mesh.positions[grid.surface.head(h)].x() && x == 0.5) grid.all[e] = 1;
    }
    EXPECT_EQ(grid.select(0.2, grid.all), grid.all);
}

TEST(SelectCreases, ShortClosedOnesAndShortEndsGo) {
    // A cube of edge .3 has no curve longer than a few spacings, but nodes: it stays.
    const Creases cube(parts::box({0.3, 0.3, 0.3}, 2));
    EXPECT_EQ(cube.select(0.3), cube.all);
    // A crease around the middle of a tube, closed, without a node.
    Creases tube(shapes::tube(24, 6));
    const auto on_ring = [&](Index v) {
        const double z = tube.surface.mesh.positions[v].z();
        return std::abs(z - tube.surface.mesh.positions[24 * 3].z()) < 1e-9;
    };
    double around = 0;
    std::fill(tube.all.begin(), tube.all.end(), 0);
    for (Index e = 0; e < tube.all.size(); ++e) {
        const Index h = tube.surface.edge_half[e];
        if (!on_ring(tube.surface.tail(h)) || !on_ring(tube.surface.head(h))) continue;
        tube.all[e] = 1;
        around += tube.surface.length[e];
    }
    ASSERT_GT(around, 0);
    EXPECT_EQ(tube.select(around / 4.1), tube.all);
    EXPECT_NEAR(tube.length(tube.select(around / 3.9)), 0, 0);
    // A part of the ring has free ends.
    for (Index e = 0, left = 6; e < tube.all.size(); ++e) {
        if (tube.all[e] != 0 && left == 0) tube.all[e] = 0;
        if (tube.all[e] != 0) --left;
    }
    EXPECT_NEAR(tube.length(tube.select(around / 4.1)), 0, 0);
    EXPECT_EQ(tube.select(around / 50), tube.all);
}

TEST(SelectCreases, TheRimsOfAThinPlateStayWhereShorterEdgesAreWorthTheirVertices) {
    const double thickness = 0.05, spacing = 0.2;  // Some 600 sites.
    const Rims rims(thickness, spacing, 600);
    EXPECT_EQ(rims.left, rims.plate.all);
    ASSERT_FALSE(rims.strips.empty());
    for (const auto& [at, length, radius] : rims.strips) {
        EXPECT_NEAR(length, 3 * thickness, 0.2 * thickness);
        const double z = position(rims.plate.surface.mesh.view(), at).z();
        EXPECT_NEAR(std::min(std::abs(z), std::abs(z - thickness)), 0, 1e-12);
    }
    // Too few sites, or none to choose lengths for: one rim stays.
    for (const double num_sites : {200, 0}) {
        const Rims one(thickness, spacing, num_sites);
        EXPECT_NEAR(one.plate.length(one.left), 14, 1e-12);
        EXPECT_TRUE(one.strips.empty());
    }
    // Narrower than what edges follow.
    const Rims thin(0.01, spacing, 600);
    EXPECT_NEAR(thin.plate.length(thin.left), 14, 1e-12);
    EXPECT_TRUE(thin.strips.empty());
}
