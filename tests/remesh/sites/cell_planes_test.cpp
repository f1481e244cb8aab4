#include "remesh/sites/cell_planes.h"

#include <gtest/gtest.h>

#include <limits>
#include "agvd/propagation/distance_bounds.h"
#include "remesh/sites/site_labels.h"
#include "support/shapes.h"

using agvd::Vec3;
using remesh::detail::CellPlanes;

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
