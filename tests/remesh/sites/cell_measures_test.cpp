#include "remesh/sites/cell_measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "agvd/propagation/distance_bounds.h"
#include "remesh/sites/site_dual.h"
#include "support/shapes.h"

using agvd::Vec3;
using remesh::detail::CellPlanes;
using remesh::detail::FaceParts;

TEST(CellPlanes, TheIntegralIsThatOfSquaredDistances) {
    CellPlanes planes;  // z = 1 on an area of 2, x = 3 on one of 5.
    planes.add(Vec3(0, 0, 2), 2, Vec3(7, -4, 1));
    planes.add(Vec3(-5, 0, 0), 5, Vec3(3, 9, 2));
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(3, 8, 1), Vec3(-2, 5, 4)}) {
        const double expected = 2 * std::pow(x.z() - 1, 2) + 5 * std::pow(x.x() - 3, 2);
        EXPECT_NEAR(planes.at(x), expected, 1e-12);
        const Vec3 step(0.5, -3, 2);
        EXPECT_NEAR(planes.growth(x, step), planes.at(x + step) - planes.at(x), 1e-12);
        EXPECT_LT((planes.half_slope(x) - Vec3(5 * (x.x() - 3), 0, 2 * (x.z() - 1))).norm(), 1e-12);
    }
}

TEST(CellPlanes, ACornerOfNoAreaHasNone) {
    const agvd::Surface surface = agvd::build_surface(shapes::grid(1).view());
    agvd::DistanceBounds labels;  // The first vertex is no nearer to its site than across an edge.
    labels.distance = {9, 0, 0, 0};
    labels.site = {0, 1, 1, 1};
    const remesh::PreparedSurface prepared(surface, std::numeric_limits<double>::infinity());
    const auto cells = remesh::detail::measure_cells(prepared, labels, 2, 1);
    EXPECT_EQ(cells.area[0], 0);
    EXPECT_EQ(cells.planes[0].spread, Eigen::Matrix3d::Zero());
    EXPECT_EQ(cells.planes[0].lift, Vec3(Vec3::Zero()));
    EXPECT_NEAR(cells.planes[1].spread.norm(), cells.area[1], 1e-12);
}

TEST(PreparedSurface, FindsThePiecesAgainThatWereReset) {
    const agvd::Surface surface =
        agvd::build_surface(shapes::jitter(shapes::sphere(3), 0.03, 5).view());
    remesh::PreparedSurface prepared(surface, 0.15, 1);
    const auto list = [&] {
        std::vector<Vec3> found;
        for (agvd::Index f = 0; f < prepared.base.surface().num_faces(); ++f) {
            prepared.pieces->for_each(f, [&](const agvd::SurfacePiece& piece) {
                found.push_back(piece.position);
                found.push_back(piece.vector);
            });
        }
        return found;
    };
    const std::vector<Vec3> first = list();
    ASSERT_GT(first.size(), 2 * prepared.base.surface().num_faces());  // Some faces have several.
    EXPECT_LE(first.size(), 2 * prepared.pieces->num_pieces_at_most());
    prepared.pieces.reset();
    prepared.find_pieces(2);
    EXPECT_EQ(list(), first);
}

TEST(FaceParts, EachPartHasTheFacesOfItsLabelsInTheirOrder) {
    const agvd::Surface surface = agvd::build_surface(shapes::torus(40, 30).view());
    std::vector<agvd::Index> label(surface.num_vertices());
    for (agvd::Index v = 0; v < label.size(); ++v) label[v] = v % 7 == 0 ? agvd::no_index : v / 11;
    for (const int num_threads : {1, 2, 8}) {
        const FaceParts parts(surface, label, num_threads);
        std::vector<agvd::Index> owners(surface.num_vertices(), 0);
        for (agvd::Index part = 0; part < parts.count(); ++part) {
            for (agvd::Index v = 0; v < label.size(); ++v)
                owners[v] += parts.has(part, label[v]) ? 1 : 0;
            std::vector<agvd::Index> expected, found;
            for (agvd::Index f = 0; f < surface.num_faces(); ++f) {
                const agvd::Triangle& t = surface.mesh.triangles[f];
                const bool is_of_part = std::any_of(
                    t.begin(), t.end(), [&](agvd::Index v) { return parts.has(part, label[v]); });
                if (is_of_part) expected.push_back(f);
            }
            parts.for_each_face(part, [&](agvd::Index f) { found.push_back(f); });
            EXPECT_EQ(found, expected) << "part " << part << " of " << parts.count();
        }
        for (agvd::Index v = 0; v < label.size(); ++v)
            EXPECT_EQ(owners[v], label[v] == agvd::no_index ? 0 : 1);
    }
}
